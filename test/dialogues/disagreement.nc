; Chains and kept place disagree, as power went before a new frame was worked out: it is said and asked.
~~ include setup.inc
-> G0 X100
<- ok
~~ wait 12
-> $3=480
<- ok
~~ wait 0.4
~~ power cut
<* ok
<- [Forward Calculating Position]
<- position loaded at:
<* *
<* *
<- ALARM: Position Lost. The kept place is not where the chains put the sled.*
-> G0 X5
<- ALARM: Halted at G0 X5: Position Lost*
>> !
<- ok
<- Laser off
-> B08
<* Message: The machine chains*
<- ok
-> G91 G0 X5 G90
<- ok
~~ wait 3
~~ quiet
; A frame that was worked out before power went is no disagreement.
~~ wait 4
-> $3=470
<- ok
<* position loaded at:
<* *
<* *
~~ wait 8
~~ power cut
<* ok
<- [Forward Calculating Position]
<- position loaded at:
<* *
<* *
~~ wait 1
~~ quiet
; A frame in which the chains fit nowhere says nothing about them: with the right one the sled is where it was.
-> $2=20000
<- ok
~~ wait 0.4
~~ power cut
<* ok
<- [Forward Calculating Position]
<- Message: Unable to find*
~~ wait 1
~~ quiet
-> $2=2978.4
<- ok
<* position loaded at:
<* *
<* *
-> G91 G0 X5 G90
<- ok
~~ wait 3
~~ quiet
