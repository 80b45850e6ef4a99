; Jogs of a sender of Grbl, and 0x85, which ends them and nothing else.
~~ include setup.inc
>> ?
~~ status <Idle|*
<* $131=1219.2
; Modes of a jog are its own; the answer comes at once.
-> $J=G91 G21 X10 F600
<- ok within 0
>> ?
~~ status <Jog|*
-> G1 X0
<- error:9
~~ wait 3
~~ sled X10 Y0 within 0.06
-> $G
<- [GC:G0 G54 G17 G21 G90 G94 *
<- ok
; A feed beyond the machine's is limited.
-> $J=G90X-10F100000
<- ok
~~ wait 4
~~ sled X-10 Y0 within 0.06
; The end of a jog, also of those that wait; the place is kept.
-> $J=G91X500F600
<- ok
-> $J=G91Y-50F600
<- ok
~~ wait 2
>> ^J
~~ wait 1
>> ?
~~ status <Idle|MPos:*
~~ wait 1
-> G0 X0 Y0
<- ok
~~ wait 3
~~ sled X0 Y0 within 0.06
; It ends no program, in which ! holds; in a jog ! ends the jog.
-> G1 X30 F600
>> ^J
<- ok
~~ wait 4
~~ sled X30 Y0 within 0.06
-> $J=G91X500F600
<- ok
~~ wait 1
>> !
~~ wait 1
>> ?
~~ status <Idle|*
; What a jog must not be.
-> $J=G91X5
<- [MSG:a jog needs F]
<- error:22
-> $J=G91F100
<- [MSG:a jog needs X, Y or Z]
<- error:16
-> $J=G1X5F100
<- [MSG:a jog takes*
<- error:16
-> $J=X99999F100
<- [MSG:that is farther than any machine reaches]
<- error:15
-> $J=XF100
<- [MSG:a number is missing behind X]
<- error:2
-> G1 X0 F600
-> $J=X5F100
<- ok
<- error:8
~~ wait 2
~~ sled X0 Y0 within 0.06
-> $J=X40F600
<- ok
~~ wait 5
-> G1 X0 F600
>> ^J
<- ok
~~ wait 5
~~ sled X0 Y0 within 0.06
>> ?
~~ status <Idle|*
