; B09 moves neither chain if it refuses the goal of one of them.
~~ include setup.inc
-> $70=1
<- ok
-> G91
<- ok
-> B09 L-5 R15999
<- B09 L-5 R15999
<- error: no chain is that long
-> G90
<- ok
-> G0 X0 Y0
<- ok
~~ wait 6
~~ sled X0 Y0 within 0.06
; B06 takes no lengths that would hang the sled far off the sheet.
-> B06 L3300 R3300
<- B06 L3300 R3300
<- error: such chains put the sled at X0 Y-2016, far off the sheet*
-> B06 L5000 R5000
<* error: such chains put the sled at*
~~ wait 1
~~ sled X0 Y0 within 0.06
-> G0 X10
<- ok
