; A stop in anything that takes its time: one ok at once, no answer for the command, and then all works.
~~ include setup.inc
-> B09 L1500 R1500
<- B09 L1500 R1500
~~ wait 1
>> !
<- ok
<* Laser off
<* position loaded at:
<* *
<* *
-> B11 S100 T30 L
<- B11 S100 T30 L
~~ wait 0.2
~~ on left
>> !^N
<- ok
<- Laser off
<* position loaded at:
<* *
<* *
~~ off left
-> B15
<- B15
~~ wait 0.5
>> !
<- ok
<* position loaded at:
<* *
<* *
-> B02 L1 R0
<- B02 L1 R0
<- Measuring out left chain
~~ wait 0.5
>> ^X^N
<- 
<- soft reset commanded
<* ok
<* Laser off
<* [Forward Calculating Position]
<* *
<* *
<* *
-> B04
<- B04
<- Testing L motor:
~~ wait 1
>> !
<- ok
<* position loaded at:
<* *
<* *
~~ off left
-> $17=1
<- ok
-> M3
<- Turning Spindle On
~~ wait 1
>> !
<- ok
<* Turning Spindle Off
<* Laser off
<* position loaded at:
<* *
<* *
~~ wait 3
~~ servo loose
-> $17=0
<- ok
; A stopped jog ends in G90, whatever of it was still waiting.
-> G1 X60 F800
<- ok
-> G91 G0 X10 G90
<- ok
>> !
<- ok
<* position loaded at:
<* *
<* *
-> G90 G0 X0 Y0
<- ok
~~ wait 12
~~ sled X0 Y0 within 0.06
