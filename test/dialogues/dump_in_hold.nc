; While all settings are shown, quick characters act at once: a stop ends the list, in a hold and without.
~~ include setup.inc
-> G1 X30 F900
~~ wait 1
>> ^H
~~ wait 1
-> $$
<- $0=*
~~ wait 0.05
>> !
<* ok
<- Laser off
<* position loaded at:
<* *
<* *
~~ wait 2
-> $$
<- $0=*
~~ wait 0.05
>> !
<* ok
<- Laser off
<* position loaded at:
<* *
<* *
; A hold and ~ in the list: the program goes on behind it.
-> G0 X0 Y0
<- ok
-> G1 X20 F900
>> ^H
~~ wait 1
-> $$
<- $0=*
~~ wait 0.05
>> ~
<* ok
<- ok
~~ wait 3
~~ sled X20 Y0 within 0.06
