; Noise that looks like a question, before a line of GroundControl's: its Stop stays a Stop.
~~ include setup.inc
>> ?
~~ status <Idle|*
<* $131=1219.2
-> G1 X95 F600 
~~ wait 2
>> !
<- ok
<* position loaded at:
<- *
<- *
>> ~^N
<- ok
~~ wait 3
~~ status <Idle,*
-> G4 P100 
<- dwell time 0.100 s
<- ok
