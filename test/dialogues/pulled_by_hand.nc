; Chains that somebody pulls while the motors are off: the machine follows, and moves on from there.
~~ include setup.inc
~~ wait 3
~~ pull left 4
~~ wait 2
~~ pull left 0
~~ wait 1
~~ power cut
<* ok
<* position loaded at:
<* *
<* *
-> G91 G0 Z0.1 G90
<- ok
~~ wait 3
~~ pull left -4
~~ wait 2
~~ pull left 0
~~ wait 1
-> G91 G0 X10 G90
<- ok
~~ wait 4
~~ sled X10 Y0 within 0.3
~~ status <Idle,MPos:10.00,0.00,0.10,WPos:0.000,0.000,0.000> within 0.3
; A heavy sled that sinks all the time is shown where it is, and a move may begin meanwhile.
~~ wait 3
~~ pull left 4
~~ wait 3
~~ status <Idle,MPos:17.86,-10.61,0.10,WPos:0.000,0.000,0.000> within 0.8
-> G0 X10 Y0
<- ok
~~ wait 2
~~ sled X10 Y0 within 0.1
~~ pull left 0
; Power that goes meanwhile finds no record.
~~ wait 3
~~ pull right 4
~~ wait 0.5
~~ power cut
<* ok
<- ALARM: Position Lost*
