; A sled that hangs beyond the sheet comes back without a jump, and goes nowhere else.
~~ include setup.inc
~~ hang X0 Y-800
~~ declare
<* ok
-> $70=1
<- ok
; Neither farther off nor along, and no arc.
-> G0 Y-850
<- error: beyond the sheet only straight moves that come nearer to it are done
-> G0 X100
<- error: beyond the sheet only straight moves that come nearer to it are done
-> G2 X0 Y-700 I0 J50
<- error: beyond the sheet only straight moves that come nearer to it are done
-> G0 Z1
<- ok
; Nearer, and no farther than asked.
-> G91 G0 Y50 G90
<- ok
~~ wait 8
~~ sled X0 Y-750 within 0.06
-> G0 X-100 Y-700
<- ok
~~ wait 11
~~ sled X-100 Y-700 within 0.06
; Through a corner of the sheet and out at the other side.
~~ hang X1150 Y-650
~~ declare
<* ok
-> G0 X1250 Y-550
<- This line leads beyond the sheet: *
<- ok
~~ wait 3
~~ errors [PE:0.00,0.00,127] within 0.6
~~ wait 6
~~ status <Idle,MPos:*
~~ sled X1219.2 Y-550 within 0.06
; Single chains may be let out and wound in anywhere.
~~ hang X0 Y-700
~~ declare
<* ok
-> G91
<- ok
-> B09 L10 R10
<* ok
-> B09 L-10 R-10
<* ok
-> G90
<- ok
~~ wait 1
~~ sled X0 Y-700 within 0.06
-> G0 X0 Y-600
<- ok
~~ wait 9
~~ sled X0 Y-600 within 0.08
