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
; What was imagined is not kept: the chains are where they were.
~~ power cut
<- PCB v1.2 Detected
<- FAKE_SERVO on
<* ok
<* position loaded at:
<- 0.00 within 0.05
<- 0.00 within 0.05
-> B99 OFF
<- B99 OFF
<- FAKE_SERVO off
<- ok
-> G0 X10
<- ok
~~ wait 6
~~ sled X10 Y0 within 0.06
; Once something has moved in imagination, the place is lost until chains are set.
-> B99 ON
<* ok
-> G0 X60
<- ok
~~ wait 8
-> B99 OFF
<- B99 OFF
<- FAKE_SERVO off
<- ALARM: Position Lost. Motion was simulated*
<- ok
-> G0 X0
<- ALARM: Halted at G0 X0: Position Lost*
>> !
<* Position Lost*
~~ wait 1
~~ power cut
<* ok
<- ALARM: Position Lost*
~~ hang X0 Y0
~~ declare
<* position loaded at:
<* *
<* *
<- ok
-> G10 Z0
<* ok
; So it is once chains were pulled by hand meanwhile, or declared.
-> B99 ON
<* ok
~~ pull left -2
~~ wait 1
~~ pull left 0
-> B99 OFF
<* FAKE_SERVO off
<- ALARM: Position Lost*
<- ok
~~ hang X0 Y0
~~ declare
<* position loaded at:
<* ok
; Once chains are set that is over: off again, and on and off without motion, lose nothing.
-> B99 OFF
<- B99 OFF
<- FAKE_SERVO off
<- ok
-> B99 ON
<* ok
~~ wait 0.5
-> B99 OFF
<- B99 OFF
<- FAKE_SERVO off
<- ok
-> B99 ON
<* ok
-> B06 L1500 R1500
<* ok
-> B99 OFF
<* FAKE_SERVO off
<- ALARM: Position Lost*
<- ok
; Motors lose their power before they run in imagination.
~~ hang X0 Y0
~~ declare
<* ok
-> G10 Z0
<* ok
-> G0 X5
<- ok
-> G4 P0
<* ok
~~ on left
-> B99 ON
<* ok
~~ off left
; Only the word ON simulates motors.
-> B99 NO
<- B99 NO
<- error: B99 is ON or OFF
-> B99 TURN IT OFF SIMULATION
<- B99 TURN IT OFF SIMULATION
<- error: B99 is ON or OFF
-> B99 ONE
<- B99 ONE
<- error: B99 is ON or OFF
-> b99 on
<- B99 ON
<- FAKE_SERVO on
<- ok
-> B99 OFFICE
<- B99 OFFICE
<- error: B99 is ON or OFF
-> B99
<- B99
<* ok
