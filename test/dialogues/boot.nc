; What a fresh board says by itself, and that it says it soon enough.
<- PCB v1.2 Detected
<- FAKE_SERVO off
<- Plumb v*
<* ready
<- ok
<- Settings are the defaults. Chain lengths are not known yet*
~~ wait 1
~~ quiet
~~ status <Idle,MPos:0.00,0.00,0.00,WPos:0.000,0.000,0.000>
~~ errors [PE:0.00,0.00,127]
; Not before somebody has set the chains does a move over the sheet make sense.
-> G0 X10
<- ALARM: Halted at G0 X10: Position Lost: set the chain lengths first*
>> !^N
<* Laser off
; Nor the way to the middle by single chains: nobody knows how much chain that would pay out.
-> B15
<* ALARM: Halted at B15: Position Lost: set the chain lengths first*
~~ wait 1
~~ chains L1651 R1651 within 0.01
