; New scales of the encoders: nothing moves by itself, and the machine stays where it believes to be.
~~ include setup.inc
-> G0 Z2
<- ok
-> G0 X50
<- ok
~~ wait 8
-> $19=3.5
<- ok
-> $20=7000
<- ok
~~ wait 0.5
~~ z 2 within 0.02
~~ status <Idle,MPos:50.00,0.00,2.00,WPos:0.000,0.000,0.000> within 0.02
; While the motors are on as well, and while it moves: then it waits.
-> G0 X60
<- ok
~~ z 2 within 0.02
-> $12=8148
<- ok
-> $13=63
<- ok
-> $20=-7000
<- ok
-> $20=7560
<- ok
-> $19=3.17
<- ok
~~ wait 3
~~ z 2 within 0.02
~~ sled X60 Y0 within 0.06
~~ status <Idle,MPos:60.00,0.00,2.00,WPos:0.000,0.000,0.000> within 0.1
~~ errors [PE:0.00,0.00,127] within 0.02
<* position loaded at:
<* *
<* *
-> $12=8113.73
<- ok
-> $13=63.5
<- ok
-> G1 X0 F900
<- ok
~~ wait 8
~~ sled X0 Y0 within 0.06
~~ z 2 within 0.02
~~ power cut
<* ok
<* position loaded at:
<- 0.00 within 0.1
<- 0.00 within 0.1
~~ wait 1
~~ status <Idle,MPos:0.00,0.00,2.00,WPos:0.000,0.000,0.000> within 0.1
; A scale that changes so little that no count does is kept all the same.
-> $20=7561
<- ok
~~ wait 2
~~ power cut
<* ok
<* position loaded at:
<* *
<* *
~~ wait 1
~~ quiet
