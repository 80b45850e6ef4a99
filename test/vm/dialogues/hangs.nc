; The main program hangs in motion: after a second the tick lets go, and nothing turns again when it
; comes back.
<* ok
<* Settings are the defaults. Chain lengths are not known yet*
-> $7=2
<- ok
-> $8=139.1
<- ok
-> B06 L1710 R1710
<* position loaded at:
<* ok
-> $17=2
<- ok
-> M3
<* ok
-> M106
<* ok
-> G1 X500 Y0 F600
~~ wait 2
~~ on left at once
~~ on right at once
~~ laser high at once
~~ spindle high at once
~~ freeze report
~~ wait 1.2
~~ off left at once
~~ off right at once
~~ laser low at once
~~ spindle low at once
~~ wait 2
~~ off left at once
~~ off right at once
~~ resets 0
~~ undriven from now
~~ wake 6
<- ALARM: The firmware was busy for too long*
<- Turning Spindle Off
~~ wait 1
~~ undriven
