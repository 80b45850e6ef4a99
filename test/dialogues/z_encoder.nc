; Z is watched as the chains are: an encoder that is not heard stops it before it ruins the piece.
~~ include setup.inc
-> G0 Z5
<- ok
~~ wait 12
~~ quiet
~~ unplug z
-> G0 Z0
<- ALARM: The sled is not keeping up with its expected position: the z motor is driven and its encoder stands still*
~~ off z
~~ plug z
>> !
<- ok
<- Laser off
<- [Forward Calculating Position]
<- position loaded at:
<* *
<* *
<- z is not known: set it first (G10 Z0 or G38.2)
; The chains are where they were, but nothing is cut at a depth that nobody knows.
-> G0 X10
<- ALARM: Halted at G0 X10: z is not known*
>> !
<* z is not known*
-> G91 G0 Z1 G90
<- ok
-> G10 Z0
<- ok
-> G0 X10
<- ok
~~ wait 6
~~ sled X10 Y0 within 0.06
~~ quiet
