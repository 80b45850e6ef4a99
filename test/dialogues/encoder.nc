; An encoder that is not heard, and a motor that turns the wrong way, stop the machine within 3 mm and are told apart.
~~ include setup.inc
-> G1 X100 F800
<- ok
~~ wait 1
~~ unplug right
<- ALARM: The sled is not keeping up with its expected position: a motor is driven and its encoder stands still*
~~ off right
~~ plug right
~~ wait 1
>> !
<- ok
<* position loaded at:
<* *
<* *
~~ wait 1
~~ reverse left
-> G91 G1 X-5 Y-5 G90
<- ok
<- ALARM: The sled is not keeping up with its expected position: a motor turns against its drive*
~~ off left
