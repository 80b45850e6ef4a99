; Power that goes in a move behind chains that were just set: the start says so. Power that goes at rest loses nothing.
<* ok
<* Settings are the defaults. Chain lengths are not known yet*
-> $7=2
<- ok
-> $8=139.1
<- ok
-> B06 L1710 R1710
<* position loaded at:
<* ok
; Settings are stored for the first time.
~~ wait 7
-> G1 X5 Y-20 F900
<- ok
~~ wait 1
-> B06 L1712 R1708
<* position loaded at:
<* ok
-> G91 G1 X30 F900 G90
~~ wait 1
~~ power cut
<* ok
<- ALARM: Position Lost. Power was lost before the position was kept.*
; The motors run on for a moment.
~~ wait 1
-> B06 L1711 R1709
<* position loaded at:
<* ok
-> G10 Z0
<* ok
~~ wait 1
~~ power cut
<* ok
<- [Forward Calculating Position]
<- position loaded at:
<* *
<* *
-> B10 L
<* [Measure: 1711.00] within 0.02
<- ok
