; An encoder that is no longer heard lets its motor run 3 mm at most, however slowly the sled goes and if it stands.
~~ include setup.inc
-> G1 X20 F800
<- ok
~~ wait 2
~~ unplug left
-> G1 Z-15 F40
<- ok
~~ wait 10
~~ chains 1717.98 1685.66 3
~~ wait 14
~~ quiet
~~ off left
; The next move says so before the chain has run far: slowly, and as a jog.
-> G1 X40 F60
<- ALARM: The sled is not keeping up with its expected position: a motor is driven and its encoder stands still*
~~ off left
~~ chains 1718.4 1685.0 3
