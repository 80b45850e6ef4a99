; A hold that comes while a line waits for its motors' power: the rest of that line comes after ~, so a jog's G90 counts. (Each byte 0x01 is a sixth of a millisecond: noise at the beginning of a line, which is dropped.)
~~ include setup.inc
~~ wait 3
>> G91 G0 X10 G90 ^N^H
~~ wait 1
~~ quiet
>> ~
<- ok
~~ wait 4
-> G0 X5 Z-1
<- ok
~~ wait 12
~~ sled X5 Y0 within 0.06
~~ off z
; A ~ that comes while z's motor wakes for the operator's jog: if z rises, it goes back.
>> ^H
~~ wait 1
>> G0 Z3^N~
~~ wait 14
~~ answers from now
~~ z -1 within 0.03
~~ status <Idle,*
; A pull begins after the hold.
>> B11 S-60 T3 L^N^H
<- B11 S-60 T3 L
~~ wait 1.5
~~ sled X5 Y0 within 0.1
~~ quiet
>> ~
~~ wait 1
>> ^H
<- ALARM: A hold ended a pull*
