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
