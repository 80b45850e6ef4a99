; Moves in mm and inches, absolute and relative; the judge says where the sled is.
~~ include setup.inc
-> G90 G0 X100 Y-50
<- ok
~~ wait 15
~~ sled X100 Y-50 within 0.06
~~ status <Idle,MPos:100.00,-50.00,0.00,WPos:0.000,0.000,0.000> within 0.02
-> G91 G00 X-25 G90
<- ok
~~ wait 6
~~ sled X75 Y-50 within 0.06
-> G20
<- ok
-> G91
<- ok
-> G00 X1 Y1
<- ok
-> G90
<- ok
~~ wait 8
~~ sled X100.4 Y-24.6 within 0.06
~~ status <Idle,MPos:3.9528,-0.9685,0.0000,WPos:0.000,0.000,0.000> within 0.002
-> G21
<- ok
-> G0 Z-2
<- ok
~~ wait 8
~~ z -2 within 0.01
; Motors rest two seconds after the last move.
~~ off left
~~ off right
~~ off z
