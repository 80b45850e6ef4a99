; $15 is the greatest feed: no F is faster, whether of G0, G1, an arc or G93.
~~ include setup.inc
-> $15=300
<- ok
-> G1 X30 F2000
~~ wait 3
~~ status <Idle,MPos:15.00,0.00,0.00,WPos:0.000,0.000,0.000> within 3
<- ok
~~ wait 5
-> G0 X0
~~ wait 3
~~ status <Idle,MPos:15.00,0.00,0.00,WPos:0.000,0.000,0.000> within 3
<- ok
~~ wait 5
; A half circle of 31.4 mm.
-> G2 X20 Y0 I10 J0 F2000
~~ wait 3.14
~~ status <Idle,MPos:10.00,10.00,0.00,WPos:0.000,0.000,0.000> within 3
<- ok
~~ wait 5
; In a fiftieth of a minute 30 mm would take 1500 mm/min.
-> G93 G1 X50 F50
~~ wait 3
~~ status <Idle,MPos:35.00,0.00,0.00,WPos:0.000,0.000,0.000> within 3
<- ok
~~ wait 5
~~ sled X50 Y0 within 0.06
