; The lines that took the most stack, of 800 that a search tried on a machine with every effect:
; written by tools/bench/run --deepest. What comes back does not matter here.
~~ include every_effect.inc
~~ stack
~~ wait 0.1
-> G21
-> G1 X10 F400
~~ wait 0
>> ?
-> B09 R0 L0
~~ wait 0.02
~~ wait 0.02
>> ^3
-> $3=470
~~ wait 1
