; The lines that took the most stack, of 800 that a search tried on a machine with every effect:
; docs/results.md says more. What comes back does not matter here.
~~ include every_effect.inc
~~ stack
~~ wait 0.1
~~ stream 40 z 0.3
~~ wait 0.02
~~ wait 0
~~ stream 40 round 0.3
~~ stream 40 z 0.3
~~ wait 0.1
~~ wait 1
