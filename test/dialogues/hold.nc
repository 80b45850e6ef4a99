; 0x84 holds along the path: within v^2 / 2a and a tick, whatever was queued; ~ goes on.
~~ include setup.inc
-> G1 X100 F900
~~ wait 3
~~ hold within 1.28
~~ status <Pause,MPos:*
~~ wait 70
; The motors keep the sled where it is.
~~ pull left 2
~~ wait 0.5
~~ on left
~~ pull left 0
~~ wait 0.5
~~ quiet
>> ~
<- ok
~~ wait 2
~~ sled X100 Y0 within 0.06
~~ status <Idle,MPos:100.00,0.00,0.00,WPos:0.000,0.000,0.000> within 0.02
; Meanwhile z may be jogged and be given its zero; then it comes back, and says so.
-> G0 Z-2
<- ok
-> G1 X0 F900
~~ wait 2
>> ^H
~~ wait 1
-> G91 G0 Z5 G90 
<- ok
~~ wait 12
~~ z 3 within 0.02
-> B10 L
<- B10L
<- [Measure: *
<- ok
; Limits of z move no chain either.
-> B17
<- B17
<- Upper limit set to: 3.00 within 0.021
<- ok
-> G0 Z4
<- ok
-> B18
<- B18
<- Lower limit set to: 3.00 within 0.021
<- ok
-> G0 Z1
<- ok
~~ wait 4
~~ z 3 within 0.03
-> B20
<- B20
<- Z Axis Upper Limit: 3.00 Lower Limit: 3.00 within 0.021
<- ok
; They move along with a height that is said in a hold.
-> G10 Z1
<- ok
-> B20
<- B20
<- Z Axis Upper Limit: 1.00 Lower Limit: 1.00 within 0.021
<- ok
-> B19
<- B19
<- Z Axis Limits Cleared
<- ok
-> G0 Z0.5
<- ok
~~ wait 4
~~ z 2.5 within 0.02
; What would move the sled is refused.
-> X20
<- error: the program waits: answer it with ~ or !; until then only z, its zero and questions
>> ~
<- Z goes back to -2.00
<- ok
-> X20
<- ok
~~ wait 3
~~ sled X20 Y0 within 0.06
~~ z 0 within 0.02
; A stop in a hold forgets the rest where the sled stands.
-> G1 X200 F900
~~ wait 3
>> ^H
~~ wait 1
>> !
<- ok
<- Laser off
<* position loaded at:
<* *
<* *
~~ wait 3
~~ off left
~~ quiet
-> G0 X0 Y0
<- ok
~~ wait 3
~~ sled X0 Y0 within 0.06
