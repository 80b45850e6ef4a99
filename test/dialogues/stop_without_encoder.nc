; An encoder comes off as Stop is pressed, before anything was learned of its motor. The count never says that the motor
; has stopped. The machine notices, and lets go of it, before it takes the count for the place.
~~ include setup.inc
-> G1 X60 F900
~~ wait 0.082
>> !
~~ unplug left
<* ALARM: The sled is not keeping up with its expected position: a motor is driven and its encoder stands still*
~~ off left
~~ wait 1.5
~~ chains 1702.4 1701.7 5
>> !
<* Position Lost: set the chain lengths first*
