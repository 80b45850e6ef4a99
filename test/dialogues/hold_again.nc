; A hold while z goes back holds too.
~~ include setup.inc
-> G1 X100 F600
~~ wait 3
>> ^H
~~ wait 1
-> G0 Z3
<- ok
~~ wait 6
>> ~
<- Z goes back*
~~ wait 1
>> ^H
~~ wait 8
~~ status <Pause,*
