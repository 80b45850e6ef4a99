; Which line may run in which state, for a sender of Grbl: G, B and $ lines go through one gate.
~~ include setup.inc
>> ?
~~ status <Idle|*
<* $131=1219.2
; A jog that has ended leaves nothing behind: a hold holds whatever comes next.
-> $J=G91 X5 F600
<- ok
~~ wait 2
-> G1 X100 F600
<- ok
-> B15
~~ wait 2
>> !
~~ wait 1
>> ?
~~ status <Hold:0|*
~~ hold 0.1
~~ wait 1
>> ~
<* ok
~~ wait 2
-> $J=G91 X50 F600
<- ok
-> B15
<- error:9
-> $1015=900
<- error:8
~~ wait 7
; Nothing moves and nothing is set in check mode.
-> G0 X50
<- ok
~~ wait 9
-> $C
<- [MSG:Enabled]
<- ok
-> B15
<- error:9
-> B09 L1500 R1500
<- error:9
-> B04
<- error:9
-> B13 L1 S5
<- error:9
-> B06 L1700 R1700
<- error:9
-> B17
<- error:9
-> $J=G91 X5 F600
<- error:8
-> $1015=800
<- error:8
-> G0 X70
<- ok
>> ?
~~ status <Check|MPos:50.000,*
~~ undriven from now
~~ wait 2
~~ undriven left
-> $C
<- [MSG:Disabled]
<- ok
>> ?
~~ status <Idle|MPos:50.000,*
~~ sled X50 Y0 within 0.06
; A client of Maslow's knows nothing of it.
-> $C
<- [MSG:Enabled]
<- ok
-> B05
<- B05
<- Firmware Version 1.28
<- ok
-> G0 X40
<- ok
~~ wait 2
~~ sled X40 Y0 within 0.06
