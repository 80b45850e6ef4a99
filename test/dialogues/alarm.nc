; A chain that is stuck: the machine stops and stays locked until Stop.
~~ include setup.inc
-> G1 X300 F800
~~ wait 3
~~ block left
<- ALARM: The sled is not keeping up*
~~ wait 0.5
~~ off left
~~ off right
-> G1 X0
-> M3
-> $$
<* $0=*
<* ok
-> B05
<- B05
<- Firmware Version 1.28
<- ok
>> ~
<- ok
-> G1 X10
~~ wait 2
~~ quiet
~~ free left
>> !
<- ok
<* position loaded at:
<* *
<* *
-> G91 G0 X5 G90
<- ok
~~ wait 3
~~ quiet
