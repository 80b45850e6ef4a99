; A bit that a program left in the work is not let go of, however long no line comes.
~~ include setup.inc
-> G1 Z-2 F300
<- ok
~~ wait 12
~~ pull left 2
~~ wait 0.5
~~ on left
~~ pull left 0
~~ wait 0.5
~~ quiet
-> G1 X10 F900
<- ok
~~ wait 6
~~ pull left 2
~~ wait 0.5
~~ on left
~~ pull left 0
~~ wait 0.5
~~ quiet
-> G0 Z2
<- ok
~~ wait 12
~~ off left
; A stop ends the program.
-> G1 Z-2 F300
<- ok
~~ wait 9
>> !
<- ok
<- Laser off
<* position loaded at:
<* *
<* *
~~ wait 3
~~ off left
