; Chains and kept place disagree, as power went before a new frame was worked out: it is said and asked.
~~ include setup.inc
-> G0 X100
<- ok
~~ wait 12
-> $3=480
<- ok
~~ wait 0.4
~~ power cut
<* ok
<- [Forward Calculating Position]
<- position loaded at:
<* *
<* *
<- ALARM: Position Lost. The kept place is not where the chains put the sled.*
-> G0 X5
<- ALARM: Halted at G0 X5: Position Lost*
>> !
<- ok
<- Laser off
-> B08
<* Message: The machine chains*
<- ok
-> G91 G0 X5 G90
<- ok
~~ wait 3
~~ quiet
