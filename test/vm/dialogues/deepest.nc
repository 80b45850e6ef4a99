; The lines that took the most stack, of 800 that a search tried on a machine with every effect:
; written by tools/bench/run --deepest. What comes back does not matter here.
~~ include every_effect.inc
~~ stack
~~ stream 40 0.3
-> G1 X2.1111111111 Y1.11111111111 F700
-> G54 G80
-> $42=2000
~~ wait 1
