; Everything that declares, moves or drives an axis, one after the other, mostly while motors are still on.
; test_power_cut_anywhere.cpp plays it again and asks at every millisecond what a power cut would leave behind.
; On a shield whose motors hang on other pins.
~~ shield 3
~~ include setup.inc
-> $42=100
<- ok
; A probe, z and the sheet in a row.
~~ probe -2
-> G38.2 Z-20 F1
-> G0 Z1
-> G1 X60 F900
<* z axis zeroed
<- ok
<- ok
<- ok
~~ wait 6
~~ probe -1000
; Chains set while the motors are on, and a move at once.
-> G1 X40 F900
<- ok
~~ wait 2.5
~~ declare
<* position loaded at:
<* ok
-> G1 X70 Y20 F900
<- ok
; z declared, and a geometry that is sent again, each with a move behind it.
-> G10 Z1
-> G1 X90 F900
-> $3=463
-> G1 X60 F900
<- ok
<- ok
<- ok
<- ok
~~ wait 6
; Chains at their marks.
-> B09 L1720 R1720
<* ok
-> $11=1720
<- ok
-> B08
<* Message: The machine chains*
<- ok
-> G91 G1 X10 G90
<- ok
; A chain that is pulled tight, then paid out.
-> B11 L S120 T0.2
<- B11 L S120 T0.2
<- ok
-> B09 L1730 R1725
<* ok
-> B11 R S-100 T0.1
<* ok
~~ wait 3
-> B11 R S100 T0.2
<* ok
~~ wait 3
-> B02 L1
<* ok
; Without a wait before motors are switched off, this one still runs when they are.
-> $9=0
<- ok
-> B11 R S-150 T0.3
<* ok
~~ wait 4
-> B11 R S150 T0.3
<* ok
~~ wait 4
-> $9=2000
<- ok
; Loops are tested, a move is stopped, and z runs alone.
-> B13 L1 S5 F5 I1
<* --PID Velocity Test Stop--
<* ok
-> B16 R1 S60 F64 I1
<* --Voltage Test Stop--
<* ok
~~ declare
<* ok
-> G0 Z0
<- ok
~~ wait 0.5
>> !
<* ok
~~ wait 1
-> $RST=$
<* ready
<- ok
<* position loaded at:
<* *
<* *
~~ wait 4
