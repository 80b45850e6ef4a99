; An encoder comes off as Stop is pressed, before anything was learned of its motor. The count never says that the motor
; has stopped, and the motor stands all the same; an alarm says so where it ran far.
~~ include setup.inc
-> G1 X60 F900
~~ wait 0.082
>> !
~~ unplug left
~~ wait 1.5
~~ chains 1702.4 1701.7 5
~~ wait 0.4
~~ chains 1702.4 1701.7 5
~~ answers from now
