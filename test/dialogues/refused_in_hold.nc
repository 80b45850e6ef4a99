; A motion that is refused in a hold halts the machine once the hold is over, and what is queued before it is cut.
~~ include setup.inc
-> G1 X30 F900
-> G4 P100 G33 X5
~~ wait 1
>> ^H
~~ wait 3
~~ quiet
~~ status <Pause,*
>> ~
~~ wait 4
<* ALARM: Halted at G4 P100 G33 X5: this machine does no G33*
~~ sled X30 Y0 within 0.06
>> !
<* position loaded at:
<- 30.00 within 0.05
<- 0.00 within 0.05
