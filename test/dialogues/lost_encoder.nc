; An encoder that is no longer heard: its motor is braked, and runs 2.4 mm at most if the machine knows which duty it
; needs either way, however slowly the sled goes and if it stands.
~~ include setup.inc
-> G1 X40 F800
<- ok
-> G1 X20
<- ok
~~ wait 6
~~ unplug left
-> G0 Z-15
~~ wait 10
~~ chains 1717.98 1685.66 2.4
~~ wait 24
~~ off left
; The next move says so, slow as it is, before the chain has run far. Where a chain pulls, the alarm comes sooner, and
; this move is refused.
-> G1 X40 F60
<* ALARM: The sled is not keeping up with its expected position: the left motor is driven and its encoder stands still*
~~ off left
~~ chains 1717.98 1685.66 2.4
~~ answers from now
