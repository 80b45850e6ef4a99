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
>> !
<* z is not known*
; Nor is it said where coordinates begin, but for z itself and by numbers alone.
-> $70=1
<- ok
-> G92 X0
<- error: z is not known*
-> G10 L20 P1 X0
<- error: z is not known*
-> G10 L2 P1 X0
<- ok
-> G92 Z0
<- ok
