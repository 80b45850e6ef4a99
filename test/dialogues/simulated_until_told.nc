; The answer to B99 says that it is kept: power may go at once.
~~ include setup.inc
-> B99 ON
<* ok
~~ power cut
<- PCB v1.2 Detected
<- FAKE_SERVO on
<* position loaded at:
<* *
<* *
-> B99 OFF
<- B99 OFF
<- FAKE_SERVO off
<- ok
~~ power cut
<- PCB v1.2 Detected
<- FAKE_SERVO off
<* ready
<- ok
<* position loaded at:
<* *
<* *
-> G0 X10
<- ok
~~ wait 4
~~ sled X10 Y0 within 0.06
