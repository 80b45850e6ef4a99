; Beyond the sheet the sled waits at its edge, which is said once; the program goes on counting.
; At the top edge the usual sled pulls usual motors round when they have no power: it sinks.
~~ include setup.inc
~~ weigh 80
-> $62=80
<- ok
-> $160=1.227e-11
<- ok
; Gears that hold the sled there.
-> $77=10
<- ok
~~ hang X0 Y590
~~ declare
<* ok
-> G0 Y620
<- This line leads beyond the sheet: the sled keeps to the edge and ends it at X0.00 Y609.60
<- ok
~~ wait 4
~~ sled X0 Y609.6 within 0.1
~~ status <Idle,MPos:0.00,609.60,0.00,WPos:0.000,0.000,0.000> within 0.05
-> G0 Y630
<- ok
-> G0 Y600
<- ok
~~ wait 4
~~ sled X0 Y600 within 0.1
; Relative moves count on.
-> G91 G0 Y30
<- This line leads beyond the sheet: *
<- ok
-> G0 Y-30 G90
<- ok
~~ wait 6
~~ sled X0 Y600 within 0.1
; An arc that bulges over the edge slides along it; its centre counts from where the program is.
-> G1 X20 Y615 F800
<- This line leads beyond the sheet: *
<- ok
-> G2 X60 Y615 I20 J0
<- ok
-> G2 X20 Y615 I-20 J0
<- ok
~~ wait 12
~~ sled X20 Y609.6 within 0.1
; A target far off costs no time, and z goes along.
-> G0 X60 Y600 Z-1
<- ok
-> G1 X80 Y5000 Z-2
<- This line leads beyond the sheet: the sled keeps to the edge and ends it at X80.00 Y609.60
<- ok
~~ wait 12
~~ status <Idle,MPos:80.00,609.60,-2.00,WPos:0.000,0.000,0.000> within 0.05
-> G0 X80 Y600
<- ok
~~ wait 2
~~ sled X80 Y600 within 0.1
; z keeps to its share of the whole way; the rest of it comes at the edge.
-> G0 X0 Y500 Z0
<- ok
-> G4 P0
<* ok
-> G1 X0 Y719.2 Z-2 F800
<- This line leads beyond the sheet: *
~~ wait 4
~~ z -0.5 within 0.1
<- ok
~~ wait 3
~~ status <Idle,MPos:0.00,609.60,-2.00,WPos:0.000,0.000,0.000> within 0.05
-> G0 X80 Y600
<- ok
; With G91 a program begins to count where the sled is, as a jog does.
-> G0 X90 Y700
<- This line leads beyond the sheet: *
<- ok
~~ wait 5
~~ off left
-> G91 G0 Y-10 G90
<- ok
~~ wait 3
~~ sled X90 Y599.6 within 0.1
; What rests at the edge is at the same place after the next start.
-> G0 Y5000
<- This line leads beyond the sheet: *
<- ok
~~ wait 6
~~ off left
~~ power
<* ready
<- ok
<- [Forward Calculating Position]
<- position loaded at:
<- 90.00 within 0.05
<- 609.60 within 0.05
~~ wait 1
~~ quiet
