; What a stop leaves of a line is no line: it is dropped to its end, without an answer.
~~ include setup.inc
>> G1 X10 !Y50 F900^N
<- ok
<- Laser off
<* position loaded at:
<* *
<* *
~~ wait 3
~~ quiet
~~ sled X0 Y0 within 0.06
~~ off left
-> G4 P1
<* ok
; The same with ctrl-X; z stays as well.
>> G1 X101 Y3 ^XZ-8 F900^N
<* soft reset*
<* ok
<* position loaded at:
<* *
<* *
~~ wait 3
~~ quiet
~~ z 0 0.02
-> G1 X5 F800
<- ok
~~ wait 2
~~ sled X5 Y0 within 0.06
; The stop's own line end is also the line's.
>> G1 X10 !^N
<- ok
<* position loaded at:
<* *
<* *
-> G1 X0 F800
<- ok
~~ wait 2
~~ sled X0 Y0 within 0.06
; A line that halts the machine cuts the line behind it, and so does an alarm.
>> G1 X--5^NG1 X7
<- ALARM: Halted at *
>> !
<- ok
<* position loaded at:
<* *
<* *
>>  Y50^N
~~ wait 2
~~ quiet
~~ sled X0 Y0 within 0.06
