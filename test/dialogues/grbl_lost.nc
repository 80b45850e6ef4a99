; A sender of Grbl at a machine whose chains nobody has set: an alarm, and what to do.
<* ready
<- ok
<* Settings are the defaults. Chain lengths are not known yet*
>> ?^N
~~ status <Alarm|*
<- $10=1
<- $13=0
<* $131=1219.2
<- [MSG:Position Lost: set the chain lengths first (B06 or B08)]
<- ok
>> ?
~~ status <Alarm|*
~~ quiet
-> $X
<- [MSG:Caution: Unlocked]
<- ok
<- [MSG:Position Lost: set the chain lengths first (B06 or B08)]
-> $J=G91X10F100
<- [MSG:Position Lost: set the chain lengths first (B06 or B08)]
<- error:15
-> G0 X10
<- [MSG:Halted at G0 X10: Position Lost: set the chain lengths first (B06 or B08). Unlock ($X).]
<- ALARM:2
-> $X
<- [MSG:Caution: Unlocked]
<- ok
<* [MSG:Position Lost: set the chain lengths first (B06 or B08)]
; Numbers: Grbl's own, and the machine's from 1000 on.
-> $1007=2
<- ok
-> $1008=139.1
<- ok
-> $1063=0.00137293
<- ok
-> $13=1
<- ok
-> $110=800
<- ok
-> $22=1
<- [MSG:this machine cannot change that number of Grbl's]
<- error:3
-> $22=0
<- ok
-> $5=1
<- [MSG:this machine has no such number; its settings begin at $1000]
<- error:3
-> $1043=1
<- [MSG:$1043 is set by B codes only *
<- error:3
-> $$
<- $10=1
<- $13=1
<- $20=0
<- $21=0
<- $22=0
<- $30=24000
<- $31=4000
<- $32=0
<- $110=800
<- $111=800
<- $120=100
<- $121=100
<- $122=10
<- $130=2438.4
<- $131=1219.2
<- $1000=2438.4 (sheet_width, mm)
<* $1015=800 (*
<* $1078=1 (*
<* ok
~~ hang X0 Y0
~~ declare
<* ok
>> ?
~~ status <Idle|MPos:0.0000,0.0000,0.0000|FS:0.0,0|* within 0.05
