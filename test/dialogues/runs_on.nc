; A motor that is let go runs on. The place is looked for when it stands, so that the next move begins where the sled is.
~~ include setup.inc
-> B11 L S-255 T0.5
<* B11*
<- ok
~~ wait 0.1
-> G0 X10 Y0
<- ok
~~ wait 5
~~ quiet
~~ sled X10 Y0 within 0.08
; So it is after a Stop in a test.
-> B16 L1 S-255 F255
<* --Voltage Test Start--
~~ wait 1
>> !
<* position loaded at:
<* *
<* *
~~ wait 0.1
-> G0 X0 Y0
<- ok
~~ wait 5
~~ quiet
~~ sled X0 Y0 within 0.08
