; A line whose motion is not done halts the machine: what follows would start from a wrong place.
; On a shield whose motors hang on other pins.
~~ shield 3
~~ include setup.inc
; The moves before it are good and come to their end; those behind it are dropped, without an answer.
-> G1 X20 Y0 F800
<- ok
-> G1 X20 Y10
<- ok
-> G2 X60 Y60 I1 J0
-> G1 X100
<- ALARM: Halted at G2 X60 Y60 I1 J0: the arc does not end on its circle. Press Stop.
~~ wait 4
~~ status <Stop,MPos:20.00,10.00,0.00,WPos:0.000,0.000,0.000> within 0.02
~~ sled X20 Y10 within 0.06
; Continue does not go on; questions are answered.
>> ~
<- ok
-> G1 X300
-> B06 L100 R100
-> B05
<- B05
<- Firmware Version 1.28
<- ok
-> $70=0
<- ok
~~ wait 2
~~ quiet
~~ sled X20 Y10 within 0.06
; Nothing proved the counts wrong: after Stop the machine goes on.
>> !
<- ok
<- Laser off
<- [Forward Calculating Position]
<- position loaded at:
<- 20.00 within 0.02
<- 10.00 within 0.02
-> G1 X30
<- ok
~~ wait 3
~~ sled X30 Y10 within 0.06
; Words with mistakes, whatever they were meant to be; the modes of the line do not change.
-> G91 X--5
<- ALARM: Halted at G91 X--5: what follows is no number: X. Press Stop.
>> !
<- ok
<- Laser off
<* position loaded at:
<* *
<* *
-> G0 X30
<- ok
~~ wait 1
~~ sled X30 Y10 within 0.06
-> X40 (a line that is longer than anything the machine has room for, as a macro might be, with more and more and more words in it so that it exceeds the two hundred and more characters)
<- ALARM: Halted at a line of more than 126 characters, which was skipped. Press Stop.
-> X40 (a second one while the machine is halted is dropped as any other, whatever length it has: more and more and more words in it so that it exceeds everything)
~~ wait 0.5
~~ quiet
>> !
<- ok
<- Laser off
<* position loaded at:
<* *
<* *
; No way behind the sprockets, and none for chains.
-> G1 X30 Y99999
<- ALARM: Halted at G1 X30 Y99999: that is farther than any machine reaches: Y. Press Stop.
>> !
<- ok
<- Laser off
<* position loaded at:
<* *
<* *
-> B09 L99999 R1651
<- B09 L99999 R1651
<- ALARM: Halted at B09 L99999 R1651: no chain is that long. Press Stop.
; A stop while the moves before the halt still run brakes.
>> !
<- ok
<- Laser off
<* position loaded at:
<* *
<* *
-> G1 X100 F500
<- ok
-> G1 X300 Y9999999 G90
<- ALARM: Halted at *
~~ wait 1
>> !
<- ok
<- Laser off
<* position loaded at:
<* *
<* *
~~ wait 2
~~ quiet
; The spindle runs until the last good move is over.
-> $17=2
<- ok
-> M3
<- Turning Spindle On
<- ok
-> G91 G1 X20 F500 G90
<- ok
-> G1 X
<- ALARM: Halted at G1 X: a number is missing behind X. Press Stop.
~~ wait 1
~~ spindle high
<- Turning Spindle Off
~~ spindle low
; A chain that jams on the way there is an alarm as ever.
>> !
<- ok
<- Turning Spindle Off
<- Laser off
<* position loaded at:
<* *
<* *
-> G0 X0 Y0
<- ok
-> G1 X
<- ALARM: Halted at *
~~ wait 0.1
~~ block left
<- ALARM: The sled is not keeping up*
~~ wait 0.5
~~ off left
~~ off right
<* Turning Spindle Off
