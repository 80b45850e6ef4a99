; The control tick dies in motion, in three ways; each time the motors are let go within 0.07 s.
<* ok
<* Settings are the defaults. Chain lengths are not known yet*
-> $7=2
<- ok
-> $8=139.1
<- ok
-> B06 L1710 R1710
<* position loaded at:
<* ok
; Its timer stands still: the main program says so and goes on.
-> M106
<* ok
-> G1 X500 Y0 F600
~~ wait 2
~~ on left at once
~~ on right at once
~~ laser high at once
~~ stop timer
~~ wait 0.07
~~ off left at once
~~ off right at once
~~ laser low at once
<- ALARM: The firmware was busy for too long*
>> !
<* ok
-> B06 L1710 R1710
<* position loaded at:
<* ok
-> G1 X5 Y0 F600
<- ok
~~ wait 6
-> M106
<* ok
-> G1 X500 Y0 F600
~~ wait 2
~~ on left at once
~~ on right at once
; It never ends: nobody is left, so after a last word comes a reset.
~~ freeze tick
~~ wait 0.07
~~ off left at once
~~ off right at once
~~ laser low at once
~~ resets 0
~~ wait 0.06
~~ resets 1
~~ off left at once
~~ off right at once
; The reset cuts a report short, and the first line of the greeting may hang on to it.
<* FAKE_SERVO off
<* The firmware hung and the watchdog started it again*
<* ALARM: Position Lost*
-> B06 L1710 R1710
<* position loaded at:
<* ok
-> G10 Z0
<* ok
-> G1 X5 Y0 F600
<- ok
~~ wait 6
-> G1 X500 Y0 F600
~~ wait 2
~~ on left at once
~~ on right at once
; Interrupts are held: only the reset is left.
~~ mask interrupts
~~ wait 0.13
~~ resets 2
~~ off left at once
~~ off right at once
<- PCB v1.2 Detected
<* The firmware hung and the watchdog started it again*
<* ALARM: Position Lost*
