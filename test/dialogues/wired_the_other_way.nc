; A negative number of counts says that a motor is wired the other way: it follows, and does not run.
~~ include setup.inc
~~ reverse z
-> G0 Z-1
<* ALARM: The sled is not keeping up with its expected position: the z motor turns against its drive*
~~ wait 1
~~ off z
>> !
<- ok
<* position loaded at:
<* *
<* *
<* *
-> $20=-7560
<- ok
-> G10 Z0
<* ok
~~ wait 1
-> G0 Z-2
<- ok
~~ wait 6
~~ quiet
~~ status <Idle,MPos:0.00,0.00,-2.00,WPos:0.000,0.000,0.000> within 0.02
-> G0 Z0
<- ok
~~ wait 5
~~ quiet
~~ status <Idle,MPos:0.00,0.00,0.00,WPos:0.000,0.000,0.000> within 0.02
