; Chains that somebody pulls while the motors are off: the machine follows, and a jog moves on from there.
~~ include setup.inc
~~ wait 3
~~ pull left 4
<- The sled moves while its motors are off.
~~ wait 2
~~ pull left 0
~~ wait 1
~~ power cut
<* ok
<* position loaded at:
<* *
<* *
~~ pull left -4
<- The sled moves while its motors are off.
~~ wait 2
~~ pull left 0
~~ wait 1
-> G91 G0 X10 G90
<- ok
~~ wait 4
~~ sled X10 Y0 within 0.5
~~ status <Idle,MPos:10.00,0.00,0.00,WPos:0.000,0.000,0.000> within 0.5
; A heavy sled that sinks all the time is shown where it is, and a jog may begin meanwhile.
~~ wait 3
~~ power cut
<* ok
<* position loaded at:
<* *
<* *
~~ pull left 4
<- The sled moves while its motors are off.
~~ wait 3
~~ status <Idle,MPos:17.86,-10.61,0.00,WPos:0.000,0.000,0.000> within 0.8
-> G91 G0 X1 G90
<- ok
~~ wait 2
~~ pull left 0
; Power that goes meanwhile finds no record.
~~ wait 4
~~ power cut
<* ok
<* position loaded at:
<* *
<* *
~~ pull right 4
<- The sled moves while its motors are off.
~~ wait 0.5
~~ power cut
<* ok
<- ALARM: Position Lost*
