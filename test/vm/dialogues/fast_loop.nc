; The loop at 200 Hz: set, kept over a reset, and then short moves as fast as the line carries them.
<* ok
<* Settings are the defaults. Chain lengths are not known yet*
-> $69=200
<- ok
-> $7=2
<- ok
-> $8=139.1
<- ok
~~ wait 2
~~ power cut
<* ok
-> B06 L1710 R1710
<* position loaded at:
<* ok
-> G1 X5 Y0 F900
<- ok
~~ wait 20
~~ stream 600
~~ wait 5
