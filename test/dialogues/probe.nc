; The probe makes z zero where it touches; GroundControl puts other words on the line.
; On a shield with another pin for the probe.
~~ shield 3
~~ include setup.inc
-> $70=1
<- ok
~~ probe -3
-> G20 G90 G38.2 Z-0.5 F1 G20 G90 M02
<- probing for z axis zero
<- max depth -0.50 in.
<- feedrate *
<- z axis zeroed
<- ok
~~ z -3 within 0.05
~~ status <Idle,MPos:0.0000,0.0000,0.0000,WPos:0.000,0.000,0.000> within 0.002
~~ probe -1000
-> G21 G90 G38.2 Z-1 F1
<- probing for z axis zero
<* error: probe did not connect
~~ wait 1
~~ quiet
; A probe that touches before z has moved says nothing about the height of the piece.
~~ probe 1000
-> G10 Z2
<- ok
-> G38.2 Z-20 F1
<- error: the probe touches already*
~~ wait 1
~~ status <Idle,MPos:0.00,0.00,2.00,WPos:0.000,0.000,0.000> within 0.02
