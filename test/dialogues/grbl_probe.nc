; A sender of Grbl counts from where the probe touched; z keeps its height. $RST=# is no calibration lost.
~~ include setup.inc
>> ?
~~ status <Idle|*
<* $131=1219.2
-> G10 L2 P1 X5 Y6 Z7
<- ok
-> G92 X1
<- ok
-> G28.1
<- ok
-> $RST=#
<- ok
-> $#
<- [G54:0.000,0.000,0.000]
<* [G28:0.000,0.000,0.000]
<* [G92:0.000,0.000,0.000]
<* [PRB:0.000,0.000,0.000:0]
<- ok
-> G28
<* error:20
-> $X
<* ok
~~ wait 1
>> ?
~~ status <Idle|*
~~ probe -3
-> G38.2 Z-5 F60
<* [PRB:0.000,0.000,-3.000:1] within 0.05
<- ok
-> G0 Z1
<* ok
-> G38.3 Z-2 F60
<* [PRB:0.000,0.000,-3.000:0] within 0.05
<- ok
-> G38.3 Z-5
<* [PRB:0.000,0.000,-3.000:1] within 0.05
<- ok
-> G38.4 Z-1
<* [PRB:0.000,0.000,-3.000:1] within 0.1
<- ok
-> $#
<* [PRB:0.000,0.000,-3.000:1] within 0.1
<- ok
-> G38.2 Z-2.5
<* ALARM:2
-> $#
<* [PRB:0.000,0.000,-3.000:0] within 0.1
<- ok
