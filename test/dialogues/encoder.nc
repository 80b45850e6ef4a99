; An encoder that is not heard, and a motor that turns the wrong way, stop the machine within 3 mm and are told apart.
; Such counts are worth nothing any more: the place is lost until chains are set, also over a power cycle.
~~ include setup.inc
~~ wait 1
-> G1 X100 F800
<- ok
~~ wait 1
~~ unplug right
<- ALARM: The sled is not keeping up with its expected position: the right motor is driven and its encoder stands still*
~~ off right
~~ plug right
~~ wait 1
>> !
<- ok
<- Laser off
<- Position Lost: set the chain lengths first*
-> G0 X0
<- ALARM: Halted at G0 X0: Position Lost*
>> !
<* Position Lost*
-> G91 G0 Z-0.5 G90
<- ok
~~ wait 8
~~ power cut
<* ok
<- ALARM: Position Lost. The encoders' counts were wrong before power was lost.*
~~ wait 1
~~ power cut
<* ok
<- ALARM: Position Lost*
~~ hang X0 Y0
~~ declare
<* position loaded at:
<* *
<* *
<- ok
-> G10 Z0
<* ok
-> G0 X20
<- ok
~~ wait 6
~~ sled X20 Y0 within 0.06
~~ power cut
<* ok
<* position loaded at:
<- 20.00 within 0.02
<* *
~~ reverse left
-> G91 G1 X-5 Y-5 G90
<- ok
<- ALARM: The sled is not keeping up with its expected position: the left motor turns against its drive*
~~ off left
>> !
<- ok
<- Laser off
<- Position Lost*
