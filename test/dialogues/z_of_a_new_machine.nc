; A machine that no client has told: z is watched all the same, and one that does not follow halts it.
<* ready
<- ok
<* Settings are the defaults. Chain lengths are not known yet*
-> G0 Z-1
<- ok
~~ wait 4
~~ z -1 0.02
~~ block z
-> G0 Z2
<* ALARM: The sled is not keeping up with its expected position*
~~ wait 1
~~ off z
