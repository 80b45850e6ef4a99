; G10 says where z is in a pause before the motors have power: they wake, and bring z back to the program's height.
~~ include setup.inc
~~ wait 4
~~ off z
-> M6 T1
<* Maslow Paused
~~ wait 1
-> G10 Z3
<- ok
~~ wait 1
~~ off z
>> ~
<- ok
<- Z goes back to 0.00
<- ok
~~ wait 8
~~ z -3 within 0.05
~~ status <Idle,MPos:0.00,0.00,0.00,WPos:0.000,0.000,0.000> within 0.05
-> G0 X10
<- ok
~~ wait 3
~~ z -3 within 0.05
