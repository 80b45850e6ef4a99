; The lines that took the most stack, of 120 that a search tried on a machine with every effect:
; written by tools/bench/run --deepest. What comes back does not matter here.
~~ include every_effect.inc
~~ wait 0.1
~~ wait 0
-> $40=0.1
~~ wait 1
