; 0x90 to 0x94 change the feed while the sled moves: 10 to 200 %, up to $15.
~~ include setup.inc
-> G1 X100 F600
>> ^2^2^2^2^2
<- [Feed: 90 %]
<- [Feed: 80 %]
<- [Feed: 70 %]
<- [Feed: 60 %]
<- [Feed: 50 %]
~~ wait 9
~~ status <Idle,MPos:44.60,0.00,0.00,WPos:0.000,0.000,0.000> within 1.2
>> ^1^3^4^4
<- [Feed: 60 %]
<- [Feed: 61 %]
<- [Feed: 60 %]
<- [Feed: 59 %]
>> ^0
<- [Feed: 100 %]
~~ wait 3
~~ status <Idle,MPos:77.00,0.00,0.00,WPos:0.000,0.000,0.000> within 1.6
<- ok
-> G1 X0 F400
>> ^1^1^1^1^1^1^1^1^1^1^1
~~ wait 9
<* [Feed: 190 %]
<- [Feed: 200 %]
~~ status <Idle,MPos:0.00,0.00,0.00,WPos:0.000,0.000,0.000> within 1
<- ok
; As letters of a text they change nothing, and a program's end brings the usual feed back.
-> (ein Schlitz – „so lang“ und für Ä)
<- ok
~~ quiet
-> M2
<- [Feed: 100 %]
<- ok
~~ wait 1
~~ sled X0 Y0 within 0.06
; At a slower feed a move of z ends too, and the next one begins.
-> $18=18
<- ok
>> ^2
<- [Feed: 90 %]
-> G1 Z-1 F90
<- ok
-> G0 Z1
<- ok
-> G4 P0
<- dwell time*
<- ok within 6
~~ z 1 within 0.05
