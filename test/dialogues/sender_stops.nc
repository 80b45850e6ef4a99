; A line is answered when less than $71 of motion is left: a sender that sends no more stops the sled.
~~ include setup.inc
-> G1 X100 F600
~~ wait 8.5
~~ quiet
<- ok
~~ status <Idle,MPos:91.50,0.00,0.00,WPos:0.000,0.000,0.000> within 1.5
~~ wait 2
~~ sled X100 Y0 within 0.06
; Short moves are answered as they come, until they last as long together.
-> G1 X101
<- ok
-> G1 X102
<- ok
-> G1 X104
<- ok
-> G1 X106
<- ok
-> G1 X116
~~ wait 0.5
~~ quiet
<- ok
~~ wait 2
; Zero: each line is answered when its motion is over.
-> $71=0
<- ok
-> G1 X126
<- ok
~~ wait 0.6
~~ sled X126 Y0 within 0.06
