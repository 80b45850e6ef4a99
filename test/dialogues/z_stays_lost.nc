; Chains that are set say nothing about z.
~~ include setup.inc
-> G0 Z5
<- ok
~~ wait 12
~~ unplug z
-> G0 Z0
<- ALARM: The sled is not keeping up*
~~ plug z
>> !
<* z is not known*
~~ hang X0 Y0
~~ declare
<* ok
-> G0 X10
<- ALARM: Halted at G0 X10: z is not known*
