; At rest the position survives; in motion the machine says that it is lost, z included, and asks.
~~ include setup.inc
-> G0 X40 Y20
<- ok
-> G0 Z-3
<- ok
~~ wait 8
~~ power cut
<* FAKE_SERVO off
<* ok
<- [Forward Calculating Position]
<- position loaded at:
<- 40.00 within 0.02
<- 20.00 within 0.02
~~ wait 1
~~ status <Idle,MPos:40.00,20.00,-3.00,WPos:0.000,0.000,0.000> within 0.02
-> G0 X50
<- ok
~~ wait 4
~~ sled X50 Y20 within 0.06
~~ wait 4
-> G1 X0 F500
~~ wait 3
~~ power cut
<* ok
<- ALARM: Position Lost. Power was lost before the position was kept.*
-> G0 X0
<* ALARM: Halted at G0 X0: Position Lost*
>> !
<* Laser off
<- Position Lost: set the chain lengths first*
-> G0 Z-2
<- ok
~~ wait 2
~~ errors [PE:0.00,0.00,127] within 0.1
~~ power cut
<* ok
<- ALARM: Position Lost. Power was lost before the position was kept.*
~~ hang X0 Y0
~~ declare
<* position loaded at:
<- 0.00 within 0.05
<- 0.00 within 0.05
<- ok
; The chains are set, but z may have been on its way too.
-> G0 X10
<- ALARM: Halted at G0 X10: z is not known*
>> !
<* z is not known*
-> G10 Z0
<* ok
-> G0 X10
<- ok
~~ wait 4
~~ sled X10 Y0 within 0.06
; Power for less than a moment, and a rest at once: that rest is kept.
~~ wait 4
-> $9=0
<- ok
-> B11 L T0
<* ok
~~ wait 1
~~ power cut
<* ok
<* position loaded at:
<- 10.00 within 0.02
<* *
~~ wait 1
~~ quiet
