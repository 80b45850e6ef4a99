; A hold in a pull ends it: a chain does not go on at a duty.
~~ include setup.inc
-> B11 S-60 T10 L
<- B11 S-60 T10 L
~~ wait 1
>> ^H
<- Laser off
<* position loaded at:
<* *
<* *
~~ wait 1
~~ off left
