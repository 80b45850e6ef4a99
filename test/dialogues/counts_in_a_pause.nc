; A program counts on beyond the sheet, whether its motors rest meanwhile or not.
~~ include setup.inc
~~ hang X1170 Y0
~~ declare
<* ok
-> G0 X1180
<- ok
-> G91
<- ok
-> G1 X100 F900
<- This line leads beyond the sheet: *
<- ok
-> G91 G1 X-100
<- ok
~~ wait 6
~~ sled X1180 Y0 within 0.2
; The same with a pause in which the motors are let go.
-> G1 X100
<- This line leads beyond the sheet: *
<- ok
~~ wait 10
~~ off left
-> G1 X-100
<- ok
~~ wait 6
~~ sled X1180 Y0 within 0.2
; A jog begins at the edge, also at once.
-> G1 X100
<- This line leads beyond the sheet: *
<- ok
-> G90
<- ok
-> G91 G0 X-10 G90
<- ok
~~ wait 8
~~ sled X1209.2 Y0 within 0.2
