; An encoder comes off as Stop is pressed, before anything was learned of its motor. The count never says that the motor
; has stopped; it stands all the same.
~~ include setup.inc
-> G1 X60 F900
~~ wait 0.082
>> !
~~ unplug left
<* position loaded at:
<* *
<* *
~~ wait 1.5
~~ chains 1702.4 1701.7 2
