; A sled that was moved while its motors were off: it is said, and no program goes on from there unasked.
~~ include setup.inc
~~ pull left 10
<- The sled moves while its motors are off.
~~ wait 3
~~ pull left 0
~~ wait 1
~~ quiet
-> G1 X60 F900
<- ALARM: Halted at G1 X60 F900: the sled moved 32 mm while its motors were off: bring it back, or begin again from where it is. Press Stop. within 1
~~ wait 2
~~ off left
>> !
<- ok
<- Laser off
<* position loaded at:
<* *
<* *
-> G1 X0 Y0 F900
<- ok
~~ wait 5
~~ sled X0 Y0 within 0.1
; An arrow key starts where the sled is; a program does not go on from there.
~~ wait 3
~~ off left
~~ power cut
<* ok
<* position loaded at:
<* *
<* *
~~ pull right 5
<- The sled moves while its motors are off.
~~ wait 2
~~ pull right 0
~~ wait 1
-> G91 G0 Y5 G90
<- ok
~~ wait 2
-> G0 X0
<- ALARM: Halted at G0 X0: the sled moved # mm while its motors were off*
~~ wait 1
>> !
<- ok
<- Laser off
<* position loaded at:
<* *
<* *
; Chains that are declared are where the sled belongs.
~~ wait 3
~~ pull left -3
<- The sled moves while its motors are off.
~~ wait 1
~~ pull left 0
~~ wait 1
~~ declare
<* position loaded at:
<* *
<* *
<- ok
-> G0 X0 Y0
<- ok
~~ wait 4
~~ sled X0 Y0 within 0.1
