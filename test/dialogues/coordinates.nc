; G53, G54 to G59, G92, G43.1: where coordinates begin; MPos stays the machine's.
~~ include setup.inc
-> G10 L2 P2 X100 Y50
<- ok
-> G55 G0 X10 Y-10
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:110.00,40.00,0.00,WPos:0.000,0.000,0.000> within 0.01
; A mode with a place on its line moves there, too.
-> G54 X20 Y10
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:20.00,10.00,0.00,WPos:0.000,0.000,0.000> within 0.01
; This place is X5 Y5 of the third system; P0 is the one in force.
-> G10 L20 P3 X5 Y5
<- ok
-> G56 G90 G0 X0 Y0
<- ok
-> G10 L20 P0 X1
<- ok
-> G0 X11
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:25.00,5.00,0.00,WPos:0.000,0.000,0.000> within 0.01
; The machine's coordinates, for one line, in G91 as well.
-> G91 G53 G0 X30 Y20 G90
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:30.00,20.00,0.00,WPos:0.000,0.000,0.000> within 0.01
-> G0 X0
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:14.00,20.00,0.00,WPos:0.000,0.000,0.000> within 0.01
; G92 moves all systems; G92.2 puts that aside, G92.3 takes it back, G92.1 forgets it.
-> G54 G92 X0
<- ok
-> G0 X1 Y0
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:15.00,0.00,0.00,WPos:0.000,0.000,0.000> within 0.01
-> G92.2
<- ok
-> G0 X2
<- ok
-> G92.3
<- ok
-> G0 X2 Y2
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:16.00,2.00,0.00,WPos:0.000,0.000,0.000> within 0.01
-> G92.1
<- ok
-> G0 X3
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:3.00,2.00,0.00,WPos:0.000,0.000,0.000> within 0.01
; A tool's length; G43 and G49 end it, and do the motion on their lines.
-> G43.1 Z1.5
<- ok
-> G0 Z1
<- ok
-> G4 P0
<* ok
~~ wait 1
~~ status <Idle,MPos:3.00,2.00,2.50,WPos:0.000,0.000,0.000> within 0.02
-> G43 H7 Z3
<- ok
-> G4 P0
<* ok
~~ wait 1
~~ status <Idle,MPos:3.00,2.00,3.00,WPos:0.000,0.000,0.000> within 0.02
-> G49 Z0
<- ok
-> G4 P0
<* ok
~~ wait 1
~~ status <Idle,MPos:3.00,2.00,0.00,WPos:0.000,0.000,0.000> within 0.02
; Plain G10 says what the machine's z is, as ever.
-> G10 Z4
<- ok
~~ wait 0.5
~~ status <Idle,MPos:3.00,2.00,4.00,WPos:0.000,0.000,0.000> within 0.02
-> $#
<- G54 X0.00 Y0.00 Z0.00
<- G55 X100.00 Y50.00 Z0.00
<- G56 X14.00 Y5.00 Z0.00
<- G57 X0.00 Y0.00 Z0.00
<- G58 X0.00 Y0.00 Z0.00
<- G59 X0.00 Y0.00 Z0.00
<- Coordinates begin at X0.00 Y0.00 Z0.00
<- ok
; The end of a program leaves the coordinates that the clients know.
-> G55 G0 X-90
<- ok
-> M30
<- ok
-> G0 X12
<- ok
-> G4 P0
<* ok
~~ wait 3
~~ status <Idle,MPos:12.00,2.00,4.00,WPos:0.000,0.000,0.000> within 0.02
; Kept over a power cycle, but for G92 and the tool.
-> G92 X0
<- ok
-> G0 X1
<- ok
-> G4 P0
<* ok
~~ wait 4
~~ power cut
<* position loaded at:
<* *
<* *
-> G0 X12
<- ok
-> G55 G0 X-80 Y0
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:20.00,50.00,4.00,WPos:0.000,0.000,0.000> within 0.02
; Inches.
-> G20 G10 L2 P6 X1 Y1 G21
<- ok
-> G59 G0 X0 Y0
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:25.40,25.40,4.00,WPos:0.000,0.000,0.000> within 0.02
; What is not said wholly is not guessed.
-> $70=1
<- ok
-> G10 X0
<- error: G10 with X or Y needs L2 or L20
-> G10 L1 P1 Z5
<- error: G10 knows L2 and L20 only
-> G10 L2 P7 X0
<- error: P is 1 to 6*
-> G10 L20 P1.5 X0
<- error: P is 1 to 6*
-> G10 L2 P1 X30000
<- error: that is farther*
-> G92
<- error: G92 needs*
-> G28.1 X1
<- error: *
-> G43.1
<- error: G43.1 needs*
-> G53 G2 X30 Y30 I5
<- error: G53 goes with*
-> G54.1 P3
<- error: this machine does no G54.1
~~ wait 0.5
~~ status <Idle,MPos:25.40,25.40,4.00,WPos:0.000,0.000,0.000> within 0.02
; A tool has a length and nothing across; inches have four decimals.
-> $70=1
<- ok
-> G43.1 X1 Z1
<- error: G43.1 needs Z*
-> G20
<- ok
-> $#
<- G54 X0.0000 Y0.0000 Z0.0000
<* ok
