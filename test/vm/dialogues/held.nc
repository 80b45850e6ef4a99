; Interrupts are held in motion for 0.1 s: too short for a reset, but nothing turns until the alarm.
<* ok
<* Settings are the defaults. Chain lengths are not known yet*
-> $7=2
<- ok
-> $8=139.1
<- ok
-> B06 L1710 R1710
<* position loaded at:
<* ok
-> G1 X500 Y0 F600
~~ wait 2
~~ on left at once
~~ on right at once
~~ mask interrupts
~~ wait 0.1
~~ unmask interrupts
~~ wait 0.001
~~ undriven from now
~~ wait 1
~~ undriven
~~ resets 0
<- ALARM: The firmware was busy for too long*
<- The sled moves while its motors are off.
