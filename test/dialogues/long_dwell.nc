; In a dwell the motors hold the sled: the bit may be in the work. $9 counts from its end.
~~ include setup.inc
-> G1 X10 F800
<- ok
-> G4 P5000
<- dwell*
~~ wait 3.5
~~ pull left 2
~~ wait 0.5
~~ on left
~~ pull left 0
<- ok
~~ wait 3
~~ off left
