; The spindle by relay and by servo, and the laser.
~~ include setup.inc
-> M3
<- ok
~~ spindle low
-> $17=2
<- ok
-> S12000 M3
<- Turning Spindle On
<- ok
~~ spindle high
-> M5
<- Turning Spindle Off
~~ wait 0.9
~~ quiet
<- ok
~~ spindle low
-> M3
<- Turning Spindle On
~~ wait 0.9
~~ quiet
<- ok
; A stop takes the relay back at once.
>> !
<- ok
~~ spindle low
<* position loaded at:
<* *
<* *
-> $17=3
<- ok
~~ spindle high
-> M4
<- Turning Spindle On
<- ok
~~ spindle low
-> M30
<- Turning Spindle Off
<- ok
~~ spindle high
-> $17=1
<- ok
-> M3
<- Turning Spindle On
~~ wait 1
~~ servo 90
~~ wait 2
~~ servo 180
~~ wait 2
~~ servo 90
; Three turns of 2 s, and 1 s for the spindle.
~~ wait 1.9
~~ quiet
<- ok
~~ servo loose
-> M5
<- Turning Spindle Off
~~ wait 3
~~ servo 0
<- ok
~~ servo loose
-> M3
<* ok
-> M106
<- Laser on
<- ok
>> !
<- ok
~~ laser low
<- Turning Spindle Off
<- Laser off
<* position loaded at:
<* *
<* *
; Pulsed by S, between $60 and $61.
-> $17=4
<- ok
-> $60=6000
<- ok
-> M3 S12000
<- Turning Spindle On
<- ok
~~ spindle 128 within 1
-> G1 X20 F600
<- ok
; A new speed is that of the moves behind it.
-> S24000
~~ wait 0.4
~~ spindle 128 within 1
<- ok
~~ spindle high
-> M5
<- Turning Spindle Off
<- ok
~~ spindle low
; The spindle turns until what was queued before M5 is done.
-> M3
<* ok
-> G1 X0 F600
<- ok
-> M5
~~ wait 1
~~ spindle high
<- Turning Spindle Off
<- ok
~~ sled X0 Y0 within 0.06
