; A hold that comes while z's motor wakes to bring z back: z stays, and goes back after the next ~.
~~ include setup.inc
~~ wait 4
~~ off z
-> M6 T1
<* Maslow Paused
~~ wait 1
-> G10 Z3
<- ok
~~ wait 1
>> ~^H
<- ok
<- Z goes back to 0.00
~~ wait 3
~~ z 0 within 0.05
~~ status <Pause,*
>> ~
<- Z goes back to 0.00
<- ok
~~ wait 1
~~ z -3 within 0.05
