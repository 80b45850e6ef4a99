; Motors that are let go at rest are watched: a sled that slides is held again, where it was.
~~ include setup.inc
-> G0 X50
<- ok
~~ wait 7
~~ off left
~~ pull left 3
<- The sled slid with its motors off: they hold it until after its next move.
~~ wait 1
~~ pull left 0
~~ on left
~~ sled X50 Y0 within 0.1
~~ wait 30
~~ on left
~~ quiet
-> G1 X60 F900
<- ok
~~ wait 2
~~ sled X60 Y0 within 0.06
~~ wait 3
~~ off left
; Motors that a stop let go are not held again: somebody may pull the chain. The next motion says so.
-> B02 L1 R0
<- B02 L1 R0
<- Measuring out left chain
~~ wait 0.5
>> !
<* position loaded at:
<* *
<* *
~~ wait 3
~~ off right
~~ quiet
