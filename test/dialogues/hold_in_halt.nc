; A refused motion: the moves before it end. A hold ends them at once; the halt stays until a stop.
~~ include setup.inc
>> G1 X8 F300^NG33 X5^N
<- ok
<- ALARM: Halted at G33 X5: this machine does no G33. Press Stop.
~~ wait 0.3
~~ hold within 0.3
~~ status <Stop,*
~~ wait 3
~~ quiet
>> ~
<- ok
~~ wait 1
~~ sled X0 Y0 within 7
~~ status <Stop,*
-> G0 X50
~~ wait 3
~~ quiet
>> !
<- ok
<* position loaded at:
<* *
<* *
-> G0 X0 Y0
<- ok
~~ wait 3
~~ sled X0 Y0 within 0.06
