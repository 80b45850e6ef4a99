; In a dwell the motors hold the sled: the bit may be in the work. $9 counts from its end.
~~ include setup.inc
-> G1 X10 F800
<- ok
-> G4 P5000
<- dwell*
~~ wait 4
~~ on left
<- ok
~~ wait 1
~~ on left
~~ wait 1.5
~~ off left
-> G82 X20 Z-1 R0 P4000 F300
~~ wait 6
~~ on left
<- ok
