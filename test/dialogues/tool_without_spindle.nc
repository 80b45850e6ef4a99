; Nobody reaches for a tool that turns: a tool change stops the spindle, and ~ does not start it.
~~ include setup.inc
-> $17=2
<- ok
-> M3
<* ok
~~ spindle high
-> G1 X5 F800
<- ok
-> T2 M6
<- Tool change to tool 2
<* Maslow Paused
~~ sled X5 Y0 within 0.06
~~ spindle low
>> ~
<- ok
<- ok
-> G1 X10
<- ok
~~ wait 2
~~ spindle low
