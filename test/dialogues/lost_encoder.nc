; An encoder that is no longer heard lets its motor run 3.2 mm at most, however slowly the sled goes and if it stands.
~~ include setup.inc
-> G1 X20 F800
<- ok
~~ wait 2
~~ unplug left
-> G0 Z-15
~~ wait 10
~~ chains 1717.98 1685.66 3.2
~~ wait 24
~~ off left
; The next move says so, slow as it is, before the chain has run far. Where a chain pulls, the alarm comes sooner, and
; this move is refused.
-> G1 X40 F60
<* ALARM: The sled is not keeping up with its expected position: a motor is driven and its encoder stands still*
~~ off left
~~ chains 1717.98 1685.66 3.2
~~ answers from now
