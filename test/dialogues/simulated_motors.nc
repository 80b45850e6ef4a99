; Without motors: the machine runs as if they followed, also GroundControl's two-line form.
~~ include setup.inc
>> B99 ON ^N ^N
<- B99 ON
<- FAKE_SERVO on
<- ok
<- ok
-> G0 X100
<- ok
~~ wait 10
~~ sled X0 Y0 within 0.06
~~ status <Idle,MPos:100.00,0.00,0.00,WPos:0.000,0.000,0.000> within 0.05
~~ power cut
<- PCB v1.2 Detected
<- FAKE_SERVO on
<* ok
<* position loaded at:
<* *
<* *
-> B99 OFF
<- B99 OFF
<- FAKE_SERVO off
<- ok
