; A hold stops z as well: while the operator lifts it, and on its way back. ~ goes on.
~~ include setup.inc
-> G1 Z-3 F300
<- ok
~~ wait 10
-> T1 M6
<- Tool change to tool 1
<- Tool Change: Please insert tool 1
<- Maslow Paused
~~ wait 1
-> G0 Z5
<- ok
~~ wait 16
~~ z 5 within 0.03
>> ~
<- ok
<- Z goes back to -3.00
~~ wait 4
>> ^H
~~ wait 1
~~ status <Pause,*
~~ z 2.5 within 0.6
~~ wait 10
~~ z 2.5 within 0.6
~~ quiet
; This ~ ends a hold: it has no ok of its own.
>> ~
<- Z goes back to -3.00
<- ok
~~ wait 1
~~ z -3 within 0.03
; A jog in a pause, and in a hold.
-> M0
<- Maslow Paused
~~ wait 1
-> G0 Z20
<- ok
~~ wait 3
>> ^H
~~ wait 12
~~ z -1.1 within 0.6
; From there it may be jogged again.
-> G0 Z0
<- ok
~~ wait 4
~~ z 0 within 0.03
>> ~
<- Z goes back to -3.00
<- ok
-> G1 X40 F600
<- ok
>> ^H
~~ wait 1
-> G0 Z-20
<- ok
~~ wait 3
>> ^H
~~ wait 12
~~ z -4.8 within 0.7
>> ~
<- Z goes back to -3.00
~~ wait 12
~~ z -3 within 0.03
~~ sled X40 Y0 within 0.06
; A stop while z is on its way ends where z stands.
-> M0
<- Maslow Paused
~~ wait 1
-> G0 Z20
~~ wait 2
>> !
<- ok
<* position loaded at:
<* *
<* *
~~ wait 10
~~ z -1.8 within 0.7
