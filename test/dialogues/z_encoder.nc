; Z is watched as the chains are: an encoder that is not heard stops it before it ruins the piece.
~~ include setup.inc
-> G0 Z5
<- ok
~~ wait 12
~~ quiet
~~ unplug z
-> G0 Z0
<- ALARM: The sled is not keeping up with its expected position: a motor is driven and its encoder stands still*
~~ off z
~~ plug z
>> !
<- ok
