; High on the sheet the chains are flat, and friction does not hold the sled: its motors keep their power at rest.
~~ include setup.inc
~~ hang X0 Y580
~~ declare
<* ok
-> G0 Y605
<- ok
~~ wait 7
<- The motors stay on: so high on the sheet the sled would slide ($77). Park it lower.
~~ on left
~~ sled X0 Y605 within 0.1
-> G0 X10
<- ok
~~ wait 7
~~ on left
~~ quiet
; Lower they are let go.
-> G0 Y350
<- ok
~~ wait 20
~~ off left
~~ off right
~~ quiet
