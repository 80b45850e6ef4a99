; More lines than there is room for: an alarm, not a loss without a word; Stop recovers.
~~ include setup.inc
-> G4 P60000
<- dwell *
-> G1 X1.1111111111 Y1.11111111111 F700
-> G1 X2.1111111111 Y1.11111111111 F700
-> G1 X3.1111111111 Y1.11111111111 F700
-> G1 X4.1111111111 Y1.11111111111 F700
<- ALARM: Buffer overflow*
-> G1 X5
~~ wait 1
~~ quiet
>> !
<- ok
<* position loaded at:
<* *
<* *
-> G0 X1
<- ok
~~ wait 2
~~ quiet
