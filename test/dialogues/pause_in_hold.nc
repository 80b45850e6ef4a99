; A pause in a hold cannot begin: the ~ that ends the hold ends no pause that comes behind it.
~~ include setup.inc
~~ answers from now
-> G1 X60 F900
-> M0
~~ wait 1
>> ^H
~~ wait 2
~~ quiet
>> ~
~~ wait 6
<- ok
<- Maslow Paused
~~ status <Pause,MPos:60.00,0.00,0.00,WPos:0.000,0.000,0.000> within 0.05
~~ wait 2
~~ status <Pause,MPos:60.00,0.00,0.00,WPos:0.000,0.000,0.000> within 0.05
~~ answers 1
>> ~
~~ wait 0.5
~~ answers 3
