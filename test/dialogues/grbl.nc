; A sender of Grbl: the first `?` turns its dialect on, B05 turns it off.
~~ include setup.inc
; Within a line and in a comment it is no question.
>> G90?(is it?)^N
<- ok
~~ wait 0.5
~~ status <Idle,MPos:*
>> ?
~~ status <Idle|MPos:0.000,0.000,0.000|FS:0,0|WCO:0.000,0.000,0.000|Ov:100,100,100> within 0.01
<- $10=1
<- $13=0
<* $131=1219.2
; No report comes that nobody asked for.
~~ wait 3
~~ quiet
-> $I
<- [VER:1.1h.*
<- [OPT:V,16,128]
<- ok
-> $G
<- [GC:G0 G54 G17 G21 G90 G94 M5 M9 T0 F450 S0]
<- ok
-> $#
<- [G54:0.000,0.000,0.000]
<- [G55:0.000,0.000,0.000]
<- [G56:0.000,0.000,0.000]
<- [G57:0.000,0.000,0.000]
<- [G58:0.000,0.000,0.000]
<- [G59:0.000,0.000,0.000]
<- [G28:0.000,0.000,0.000]
<- [G30:0.000,0.000,0.000]
<- [G92:0.000,0.000,0.000]
<- [TLO:0.000]
<- [PRB:0.000,0.000,0.000:0]
<- ok
-> $N
<- $N0=
<- $N1=
<- ok
-> $
<- [HLP:*
<- ok
-> $H
<- [MSG:no switches to search for.*
<- error:5
; What Grbl has and this machine has not, and what neither has.
-> $SLP
<- [MSG:Invalid statement]
<- error:3
-> $Q
<- [MSG:Invalid statement]
<- error:3
; A dwell is in seconds.
~~ answers from now
-> G4 P2
~~ wait 1.9
~~ answers 0
<* ok within 0.3
; A move: the state, the feed, the place, and where the work begins.
-> G92 X10 Y5
<- ok
-> G1 X110 F600
~~ wait 3
>> ?
~~ status <Run|MPos:29.000,0.000,0.000|FS:600,0|WCO:-10.000,-5.000,0.000|Ov:100,100,100> within 1
; A hold and the way on, without answers.
>> !
~~ wait 0.05
>> ?
~~ status <Hold:1|*
~~ wait 2
>> !?
~~ status <Hold:0|MPos:29.500,0.000,0.000|FS:0,0|WCO:-10.000,-5.000,0.000|Ov:100,100,100> within 1.5
; Unlike that of an operator of a Maslow, a line in a hold waits.
~~ answers from now
-> G4 P10
~~ wait 1
~~ answers 0
>> ~
~~ wait 1
~~ answers 0
>> ?
~~ status <Run|*
<* ok
<* ok
~~ wait 2
>> ?
~~ status <Idle|MPos:100.000,0.000,0.000|* within 0.05
-> G92.1
<- ok
; Overrides are in the status; nothing else is said.
>> ^1^1^3^6^A^D?
~~ status <Idle|MPos:100.000,0.000,0.000|FS:0,0|WCO:0.000,0.000,0.000|Ov:121,50,109> within 0.01
>> ^0^5^9?
~~ status <Idle|MPos:100.000,0.000,0.000|FS:0,0|WCO:0.000,0.000,0.000|Ov:100,100,100> within 0.01
~~ quiet
; A soft reset keeps the dialect and the place.
-> G91 G20
<- ok
>> ^X
<- Grbl 1.1h ['$' for help]
>> ?
~~ status <Idle|MPos:100.000,0.000,0.000|* within 0.05
-> $G
<- [GC:G0 G54 G17 G21 G90 G94 M5 *
<- ok
; Mistakes, alarms, the lock.
-> G1 X1Q
<- [MSG:Halted at G1 X1 Q: a number is missing behind Q. Unlock ($X).]
<- error:2
>> ?
~~ status <Alarm|*
-> G0 X0
<- error:9
-> 
<- ok
-> $X
<- [MSG:Caution: Unlocked]
<- ok
~~ wait 0.5
>> ?
~~ status <Idle|*
-> G0 X99999
<- [MSG:Halted at G0 X99999: *
<- ALARM:2
-> $J=X5F100
<- error:8
>> ^X
<* Grbl 1.1h ['$' for help]
-> G98
<- ok
; A reset in a move tells no goal as the place.
-> $J=G91X0F100
<- ok
-> G1 X300 F600
~~ wait 2
>> !
~~ wait 1
>> ^X??
<- Grbl 1.1h ['$' for help]
~~ status <Run|MPos:119.000,0.000,0.000|* within 2
~~ wait 1
-> G0 X100
<- ok
~~ wait 3
; Check mode does nothing.
-> $C
<- [MSG:Enabled]
<- ok
-> G1 X50 F500
<- ok
-> G37
<- [MSG:this machine does no G37]
<- error:20
>> ?
~~ status <Check|*
-> $C
<- [MSG:Disabled]
<- ok
~~ wait 1
~~ sled X100 Y0 within 0.06
; The version turns the dialect off.
-> B05
<- B05
<- Firmware Version 1.28
<- ok
~~ wait 0.5
~~ status <Idle,MPos:100.00,0.00,0.00,WPos:0.000,0.000,0.000> within 0.03
>> !
<- ok
