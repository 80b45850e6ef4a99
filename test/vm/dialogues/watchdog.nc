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
~~ on
~~ laser high
~~ stop timer
~~ wait 0.07
~~ off
~~ laser low
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
~~ on
; It never ends: nobody is left, so after a last word comes a reset.
~~ hang tick
~~ wait 0.07
~~ off
~~ laser low
~~ resets 0
~~ wait 0.06
~~ resets 1
~~ off
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
~~ on
; Interrupts are held: only the reset is left.
~~ hold interrupts
~~ wait 0.13
~~ resets 2
~~ off
<- PCB v1.2 Detected
<* The firmware hung and the watchdog started it again*
<* ALARM: Position Lost*
