; A chain that is stuck: the machine stops and stays locked until Stop.
~~ include setup.inc
-> G1 X300 F800
~~ wait 3
~~ block left
<- ALARM: The sled is not keeping up with its expected position: the left motor is driven*
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
; What held the chain may have cut its encoder off as well: nobody knows where the sled is.
<* Position Lost: set the chain lengths first*
~~ hang X0 Y0
~~ declare
<* position loaded at:
<* ok
-> G91 G0 X5 G90
<- ok
~~ wait 3
~~ quiet
