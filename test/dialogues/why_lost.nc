; A start says why the position was lost, however often power goes before it is set again.
~~ include setup.inc
~~ wait 1
-> B99 ON
<* ok
-> G0 X5
<- ok
~~ wait 2
-> B99 OFF
<* ALARM: Position Lost. Motion was simulated, so the chains are elsewhere.*
<- ok
~~ wait 4
~~ power cut
<* FAKE_SERVO off
<* ok
<- ALARM: Position Lost. Motion was simulated, so the chains are elsewhere.*
~~ wait 1
; A later reason does not take its place.
-> G0 Z-3
<- ok
~~ wait 1
~~ power cut
<* ok
<- ALARM: Position Lost. Motion was simulated, so the chains are elsewhere.*
~~ hang X0 Y0
~~ declare
<* ok
-> G10 Z0
<- ok
~~ wait 1
~~ power cut
<* ok
<* position loaded at:
<* *
<* *
; Lengths that are set end the doubt: a later reason is said, also before a position is kept.
-> B99 ON
<* ok
-> G0 X5
<- ok
~~ wait 2
-> B99 OFF
<* ALARM: Position Lost. Motion was simulated, so the chains are elsewhere.*
<- ok
~~ hang X0 Y0
~~ declare
<* ok
; Simulation moved z as well, so z is to be set too.
-> G0 X200
<- ALARM: Halted at G0 X200: z is not known*
>> !
<- ok
<* z is not known*
-> G10 Z0
<- ok
-> G0 X200
<- ok
~~ wait 1
~~ power cut
<* ok
<- ALARM: Position Lost. Power was lost before the position was kept.*
