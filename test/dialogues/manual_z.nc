; Without a z motor the user is asked, twice in a row, before the sheet's move begins.
~~ include setup.inc
-> $16=0
<- ok
-> G1 X10 Z5 F800
<- Message: Please adjust Z-Axis to a depth of +5.00 mm
<- Maslow Paused
~~ wait 3
~~ sled X0 Y0 within 0.06
>> ~
<- ok
<- ok
~~ wait 3
~~ sled X10 Y0 within 0.06
~~ status <Idle,MPos:10.00,0.00,5.00,WPos:0.000,0.000,0.000> within 0.05
-> G0 Z-3
<- Message: Please adjust Z-Axis to a depth of -3.00 mm
<- Maslow Paused
>> ~
<- ok
<- ok
-> G0 Z-3.05
<- ok
~~ status <Idle,MPos:10.00,0.00,-3.00,WPos:0.000,0.000,0.000> within 0.02
; An arc that falls meanwhile asks as well, or keeps its height.
-> G2 X10 Y0 I5 J0 Z-6
<- ok
-> G4 P0
<* ok
~~ wait 0.5
~~ status <Idle,MPos:10.00,0.00,-3.00,WPos:0.000,0.000,0.000> within 0.02
-> G0 Z0
<- Message: Please adjust Z-Axis to a depth of 0.00 mm
<- Maslow Paused
>> ~
<- ok
<- ok
; A stop in the move before it: nobody is asked for a height.
-> G1 X40 F600
<- ok
-> G0 Z-6
~~ wait 0.5
>> !
<- ok
<- Laser off
<- [Forward Calculating Position]
<- position loaded at:
<* *
<* *
~~ wait 2
~~ quiet
