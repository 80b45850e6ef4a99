; A sled on its fast way: a motor that is let go would run on for 4 mm.
~~ include setup.inc
-> G1 X40 F1000
<- ok
-> G1 X0
<- ok
-> G1 X200
~~ wait 5
~~ unplug left
<* ALARM: The sled is not keeping up with its expected position: the left motor is driven and its encoder stands still*
~~ off left
~~ wait 1
~~ chains 1751.9 1653.4 1.2
~~ answers from now
