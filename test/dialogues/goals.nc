; G28 and G30: back to a place that was kept, with z first where it rises, last where it falls.
~~ include setup.inc
; Nobody said where to, so nothing moves.
-> G28
<- ALARM: Halted at G28: no place is kept for it*
>> !
<- ok
<* position loaded at:
<* *
<* *
-> G0 X10 Y20 Z2
<- ok
-> G28.1
<- ok
-> G0 X60 Y0 Z-1
<- ok
-> G28
; Up before across: while z rises the sled hangs where it was.
~~ wait 4
~~ sled X60 Y0 within 0.06
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:10.00,20.00,2.00,WPos:0.000,0.000,0.000> within 0.02
-> G0 X30 Y30 Z3
<- ok
-> G30.1
<- ok
-> G0 X40 Y40 Z5
<- ok
-> G4 P0
<* ok
; Across before down.
-> G30
~~ wait 2.3
~~ sled X30 Y30 within 0.06
~~ status <Idle,MPos:30.00,30.00,4.20,WPos:0.000,0.000,0.000> within 0.8
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:30.00,30.00,3.00,WPos:0.000,0.000,0.000> within 0.02
; As programs begin and end: z alone, wherever G91 stands on the line; then x and y.
-> G28 G91 Z0
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:30.00,30.00,2.00,WPos:0.000,0.000,0.000> within 0.02
-> G91 G28 X0 Y0
<- ok
-> G90
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:10.00,20.00,2.00,WPos:0.000,0.000,0.000> within 0.02
; By way of another place; an axis without word stays.
-> G30 X50
<- ok
~~ wait 1
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:30.00,20.00,2.00,WPos:0.000,0.000,0.000> within 0.02
; Kept without power.
~~ wait 4
~~ power cut
<* position loaded at:
<* *
<* *
-> G28
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:10.00,20.00,2.00,WPos:0.000,0.000,0.000> within 0.02
-> $#
<* G28 X10.00 Y20.00 Z2.00
<- G30 X30.00 Y30.00 Z3.00
<* ok
