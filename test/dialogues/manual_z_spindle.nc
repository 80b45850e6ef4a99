; Nobody has to reach for a router whose bit turns in the air. To go into the work it has to turn.
~~ include setup.inc
-> $16=0
<- ok
-> $17=2
<- ok
-> M3
<- Turning Spindle On
<- ok
~~ spindle high
-> G0 Z5
<- Turning Spindle Off
<- Message: Please adjust Z-Axis to a depth of +5.00 mm
<- Maslow Paused
~~ wait 1
~~ spindle low
>> ~
<- ok
<- Turning Spindle On
<- ok
~~ spindle high
-> G1 Z-3 F300
<- Message: Please adjust Z-Axis to a depth of -3.00 mm
<- Maslow Paused
~~ wait 1
~~ spindle high
>> ~
<- ok
<- ok
; A spindle that stands is not started, and after a stop it stays off.
-> M5
<- Turning Spindle Off
<- ok
-> G0 Z5
<- Message: Please adjust Z-Axis to a depth of +5.00 mm
<- Maslow Paused
>> ~
<- ok
<- ok
~~ spindle low
-> M3
<- Turning Spindle On
<- ok
-> G0 Z8
<- Turning Spindle Off
<- Message: *
<- Maslow Paused
>> !
<- ok
<- Turning Spindle Off
<* position loaded at:
<* *
<* *
~~ wait 2
~~ spindle low
