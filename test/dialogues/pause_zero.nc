; In a pause z is declared, without a jog before: z comes back as fast as it can.
~~ include setup.inc
-> G0 Z5
<- ok
-> M0
<- Maslow Paused
~~ wait 1
-> G10 Z0
<- ok
>> ~
<- ok
<- Z goes back to 5.00
<- ok
~~ wait 20
~~ status <Idle,MPos:0.00,0.00,5.00,WPos:0.000,0.000,0.000> within 0.02
