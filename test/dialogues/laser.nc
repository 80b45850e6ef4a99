; The laser is on only while a G1 to G3 moves.
~~ include setup.inc
-> M106
<- Laser on
<- ok
~~ laser low
-> G1 X20 F600
~~ wait 1
~~ laser high
<- ok
~~ wait 1.5
~~ laser low
-> G0 X0
~~ wait 0.5
~~ laser low
<- ok
~~ wait 1
; A pause and a hold put it out, and going on lights it again.
>> G1 X20^NM0^NG1 X40^N
~~ wait 1
~~ laser high
<- ok
<- Maslow Paused
~~ laser low
>> ~
<- ok
<- ok
~~ wait 0.5
~~ laser high
~~ hold within 1
~~ laser low
>> ~
~~ wait 0.3
~~ laser high
<- ok
~~ wait 1.5
; A stop puts it out at once, and it stays out.
-> G1 X0
~~ wait 1
>> !
<- ok
~~ wait 0.02
~~ laser low
<* position loaded at:
<* *
<* *
-> G1 X40
~~ wait 1
~~ laser low
<- ok
; By S and speed, where the pin is pulsed.
-> $72=1
<- ok
-> M106 S200
<- Laser on
<- ok
-> G1 X0 F600
~~ wait 1
~~ laser 200 within 1
<- ok
~~ wait 1
-> G1 X100 S100
~~ wait 1
~~ laser 100 within 1
>> ^2^2^2^2^2
~~ wait 1
~~ laser 50 within 1
>> ^0
<* ok
~~ wait 1
; M107 is for the moves behind it.
>> G1 X50^NM107^NG1 X0^N
~~ wait 2
~~ laser 100 within 1
<- ok
<- Laser off
<- ok
~~ wait 2
~~ laser low
<- ok
~~ wait 1.5
-> M106
<- Laser on
<- ok
-> G1 X30
~~ wait 1
~~ laser 255 within 1
<- ok
-> M2
<- ok
-> G1 X0
~~ wait 1
~~ laser low
<- ok
~~ wait 1
; Motors in imagination light nothing.
-> B99 ON
<- B99 ON
<- FAKE_SERVO on
<- ok
-> M106
<- Laser on
<- ok
-> G1 X30
~~ wait 1
~~ laser low
<- ok
