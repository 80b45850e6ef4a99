; Nothing drives a sled whose chains put it nowhere, and no chain has a length that nobody said.
~~ include setup.inc
-> $70=1
<- ok
-> B06 L1651
<- B06 L1651
<- error: B06 needs the lengths of both chains, L and R
-> B06 R1651
<- B06 R1651
<- error: B06 needs the lengths of both chains, L and R
-> B06
<- B06
<- error: B06 needs the lengths of both chains, L and R
; Nothing was changed by them.
~~ status <Idle,MPos:0.00,0.00,0.00,WPos:0.000,0.000,0.000> within 0.05
-> B06 L100 R100
<- B06 L100 R100
<* Message: Unable to find valid machine position*
<- ok
-> B15
<- B15
<- error: the chains put the sled nowhere: set their lengths first (B06 or B08)
-> G0 X10
<- error: the chains put the sled nowhere: set their lengths first (B06 or B08)
-> G28.1
<- error: the chains put the sled nowhere: set their lengths first (B06 or B08)
-> G92 X0
<- error: the chains put the sled nowhere: set their lengths first (B06 or B08)
-> G81 X0 Y0 Z-1 R1
<- error: the chains put the sled nowhere: set their lengths first (B06 or B08)
-> G80
<- ok
~~ z 0 0.01
~~ wait 1
~~ off left
~~ off right
; A test or a single chain must name its chain.
-> B02
<- B02
<- error: B02 and B11 need a chain: L or R
-> B11 S100 T1
<- B11 S100 T1
<- error: B02 and B11 need a chain: L or R
; A chain that B09 does not name stays.
~~ hang X0 Y0
~~ declare
<* ok
-> B10 R
<- B10 R
<- [Measure: *
<- ok
-> B09 L1600
<- B09 L1600
<- ok
-> B10 L
<- B10 L
<- [Measure: 1600.00] within 0.03
<- ok
~~ chains L1600 R1701.79 within 0.05
