; What programs say: done, harmless, or halts; never passed over with an ok.
~~ include setup.inc
-> $70=1
<- ok
; The preambles of programs.
-> G90 G94 G17 G21 G40 G49 G80 G54 G64 G61 G97 G50 G69 G15 G91.1 G98
<- ok
-> O1000
<- ok
; A place belongs to the mode of motion, whatever code stands before it.
-> G0 X1 Y1
<- ok
-> G40 X2
<- ok
-> G94 Y2
<- ok
-> M8 X3
<- Command M8 unsupported and ignored.
<- ok
-> G17 G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:3.00,2.00,0.00,WPos:0.000,0.000,0.000> within 0.02
-> Y3 M2
<- ok
; Feed as time: this way of 20 mm takes 0.05 minutes, that is 400 mm/min.
-> G93 G1 X23 F20
~~ wait 1.5
~~ status <Idle,MPos:12.00,3.00,0.00,WPos:0.000,0.000,0.000> within 2
<- ok
-> G1 X3
<- error: with G93 each line needs its F
-> F30 G2 X23 Y23 I0 J10
<- ok
-> G94 G1 X20 F800
<- ok
; Planes are remembered; straight moves need none.
-> G18
<- ok
-> G1 X3 Y3
<- ok
-> G2 X5 Y5 J2
<- error: an arc needs R, or a centre in its plane (G17 to G19)
-> G17
<- ok
; Centres as places.
-> G0 X10 Y0
<- ok
-> G90.1 G2 X0 Y-10 I0 J0 F800
<- ok
-> G3 X10 Y0 I0
<- error: with G90.1 an arc needs both letters of its centre
-> G91.1 G3 X10 Y0 I0 J10
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:10.00,0.00,0.00,WPos:0.000,0.000,0.000> within 0.02
; What this machine cannot do.
-> G41 D1
<- error: this machine does no G41
-> G42 X5
<- error: this machine does no G42
-> G95
<- error: this machine does no G95
-> G96 S100
<- error: this machine does no G96
-> G5 X5 Y5 I1 J1
<- error: this machine does no G5
-> G51 X2
<- error: this machine does no G51
-> G52 X2
<- error: this machine does no G52
-> G68 R45
<- error: this machine does no G68
-> G38.6 Z-5
<- error: this machine does no G38.6
-> G123
<- error: this machine does no G123
-> M98 P1000
<- error: subprograms*
-> M99
<- error: subprograms*
-> O100 CALL
<- error: there is no such code: O
-> G1 X5 A90
<- error: there is no axis A
-> G3 X10 Y0 I-5 J0 P3
<- error: an arc goes round once*
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:10.00,0.00,0.00,WPos:0.000,0.000,0.000> within 0.02
