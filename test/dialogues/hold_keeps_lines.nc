~~ include setup.inc
-> G1 X3 F400
<- ok
>> ^H
-> G91
~~ wait 2
>> ~
<- ok
~~ wait 2
-> G1 X5
<- ok
~~ wait 2
~~ sled X8 Y0 within 0.06
