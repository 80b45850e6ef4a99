; Edges of an encoder that come in pairs cannot be counted. More than an eighth of $42 of them, 0.25 mm of chain, is an alarm, and the position is lost.
~~ include setup.inc
-> G1 X20 F800
<- ok
~~ miss left 14
~~ wait 6
~~ quiet
-> G1 X0 F800
<- ok
~~ miss left 6
<- ALARM: An encoder missed steps (B30 says which), so its counts are wrong. Check the cables, press Stop, set the chains (B06 or B08), or z (G10 Z0).
~~ wait 0.2
~~ off left
~~ off right
>> !
<- ok
<- Laser off
<- Position Lost: *
~~ wait 1
-> B30
<* [Telemetry|error:#,#,#|dry:#|tick:#|illegal:#,0,0|*
<- ok
~~ quiet
~~ power cut
<* ok
<* ALARM: Position Lost. The encoders' counts were wrong before power was lost.*
; Chains that are set begin afresh. Steps missed before no longer count.
~~ hang X0 Y0
~~ declare
<* position loaded at:
<* ok
-> G10 Z0
<* ok
-> G1 X20 F800
<- ok
~~ miss right 14
~~ wait 8
~~ declare
<* position loaded at:
<* ok
-> G1 X0 F800
<- ok
~~ miss right 14
~~ wait 8
~~ quiet
~~ declare
<* position loaded at:
<* ok
; Z is lost by itself: the chains are known.
-> $42=0.5
<- ok
-> G1 Z-10 F40
~~ wait 1
~~ miss z 20
~~ wait 2
~~ miss z 20
~~ wait 2
~~ miss z 20
~~ wait 2
~~ quiet
~~ miss z 20
<- ALARM: An encoder missed steps*
>> !
<- ok
<- Laser off
<* z is not known*
-> G10 Z0
<* ok
-> G1 X10 F800
<- ok
; A limit that watches nothing watches no steps.
-> $42=2000
<- ok
~~ miss left 60
~~ wait 6
~~ quiet
