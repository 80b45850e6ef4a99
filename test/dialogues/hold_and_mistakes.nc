; A mistake of the operator in a hold is an error: the program that waits is not halted.
~~ include setup.inc
-> G1 X100 F600
~~ wait 2
>> ^H
~~ wait 1
-> B10 L--
<- B10L--
<- error: what follows is no number: L
-> B17 L1e9
<- B17L1E9
<- error: no chain is that long
-> G0 Z1
<- ok
~~ wait 3
>> ~
<- Z goes back to 0.00
<- ok
~~ wait 12
~~ sled X100 Y0 within 0.06
; A line that is too long is refused too, and the program goes on.
-> G1 X0 F600
~~ wait 2
>> ^H
~~ wait 1
-> G0 Z1 (a line that is longer than anything the machine has room for, as a macro might be, with more and more and more words in it)
<- error: a line of more than 126 characters, which was skipped
>> ~
<- ok
~~ wait 2
~~ sled X0 Y0 within 0.06
