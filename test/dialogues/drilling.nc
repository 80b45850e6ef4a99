; Holes: G81 to G83, G98 and G99, G80.
~~ include setup.inc
-> G0 Z3
<- ok
-> G99 G81 X10 Y10 Z-1 R1 F800
<- ok
-> X20
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:20.00,10.00,1.00,WPos:0.000,0.000,0.000> within 0.02
-> G98 X30
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:30.00,10.00,3.00,WPos:0.000,0.000,0.000> within 0.02
; The hole is as deep as it says, and the bit stays there for P.
-> G98 G82 X35 Z-1 R1 P3000
~~ wait 7.8
~~ z -1 within 0.03
~~ sled X35 Y10 within 0.06
<* ok
-> G80 G4 P0
<* ok
~~ wait 0.5
~~ z 3 within 0.03
-> G0 X30
<- ok
; Repeats, inches, G91, a dwell, in a system of coordinates.
-> G10 L2 P3 X30 Y0
<- ok
-> G56 G91 G82 X5 R-2 Z-1 P500 L2 G90
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:40.00,10.00,3.00,WPos:0.000,0.000,0.000> within 0.02
-> G83 X0 Y0 Z-1 R1 Q0.8
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:30.00,0.00,3.00,WPos:0.000,0.000,0.000> within 0.02
; After G80 a bare place is no motion any more; a bare z that lifts the bit is a rapid move.
-> G54 G80
<- ok
-> Z4
<- ok
-> G80 Z5.5
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:30.00,0.00,5.50,WPos:0.000,0.000,0.000> within 0.02
-> X5
<- ALARM: Halted at X5: no motion is in force after G80*
>> !
<- ok
<* position loaded at:
<* *
<* *
-> G0 X0 Y0
<- ok
-> $70=1
<- ok
-> G80 Z5
<- error: no motion is in force after G80*
-> X1 Z9
<- error: no motion is in force after G80*
-> G0 Z3
<- ok
-> G81 X5 Z-1
<- error: a hole needs R and Z
-> G83 X5 Z-1 R1
<- error: G83 needs Q*
-> G83 X5 Z-1 R1 Q0.0000001
<- error: G83 needs Q, the depth of a peck, of 0.01 mm at least
-> G81 X5 Z2 R1
<- error: a hole's Z is below its R
-> G80
<- ok
-> G18 G81 X5 Z-1 R1
<- error: holes are drilled*
-> G17 G93 X5
<- error: no hole is drilled*
-> G94 G80 G89 X5 Z-1 R1
<- error: this machine does no G89
-> G0 X1
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:1.00,0.00,3.00,WPos:0.000,0.000,0.000> within 0.02
; No hole at the edge instead of one beyond it.
~~ hang X0 Y590
~~ declare
<* ok
-> G0 X0 Y600
<- ok
-> G81 Y620 Z-1 R1
<* error: the hole is beyond the sheet
-> G80 G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:0.00,609.60,3.00,WPos:0.000,0.000,0.000> within 0.02
; Holes count from where each axis begins.
~~ hang X0 Y0
~~ declare
<* ok
-> G10 Z0
<- ok
-> G10 L2 P2 X10 Y20 Z1
<- ok
-> G55 G0 Z2
<- ok
-> G98 G81 X5 Y-15 Z-2 R1
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:15.00,5.00,3.00,WPos:0.000,0.000,0.000> within 0.02
