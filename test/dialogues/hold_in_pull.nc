; A hold in a pull ends it: a chain does not go on at a duty. The line is never answered, so an alarm
; says what happened.
~~ include setup.inc
-> B11 S-60 T10 L
<- B11 S-60 T10 L
~~ wait 1
>> ^H
<- ALARM: A hold ended a pull or a test of motors. Press Stop.
~~ wait 1
~~ off left
>> !
<- ok
<- Laser off
<* position loaded at:
<* *
<* *
-> B04
<- B04
<- Testing L motor:
~~ wait 1
>> ^H
<- ALARM: A hold ended a pull or a test of motors. Press Stop.
