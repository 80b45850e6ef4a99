; 126 characters sent without waiting while a slow move runs, with ~ in the middle; none is lost.
~~ include setup.inc
~~ answers from now
-> G1 X02 F60
-> G1 X04 Y1.00
-> G1 X02 Y2.00
-> G1 X04 Y3.00
-> M106
-> G1 X02 Y4.00
-> G1 X04 Y5.00
-> G1 X02 Y6.0
>> ~
~~ wait 30
~~ answers 9
~~ sled X2 Y6 within 0.06
; Armed, and dark at rest.
~~ laser low
; The same with a stop: what waits is owed nothing.
-> G1 X12 F60
-> M107
-> G1 X20
-> G1 X40
~~ wait 3
~~ answers from now
>> !
~~ wait 4
~~ answers 1
~~ laser low
