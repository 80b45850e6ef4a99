; A number that no machine reaches is refused by name, and a word that means nothing is not dropped.
~~ include setup.inc
-> G1 X Y5
<- ALARM: Halted at G1 X Y5: a number is missing behind X. Press Stop.
>> !
<- ok
<* position loaded at:
<* *
<* *
-> G1 Z1e5
<- ALARM: Halted at G1 Z1E5: that is farther than any machine reaches: Z. Press Stop.
>> !
<- ok
<* position loaded at:
<* *
<* *
-> $70=1
<- ok
-> G43.1 Z1e5
<- error: that is farther than any machine reaches: Z
-> G92 Z-10001
<- error: that is farther than any machine reaches: Z
-> G20 G0 X-700
<- error: that is farther than any machine reaches: X
-> G21 G10 Z10001
<- error: that is farther than any machine reaches: Z
-> G38.2 Z-10001
<- error: that is farther than any machine reaches: Z
; Neither does a sum of numbers end at a limit that nobody has set.
-> G43.1 Z9000
<- ok
-> G0 Z1001
<- error: no z axis is that long
-> G38.2 Z1001
<- error: no z axis is that long
-> G49 G0 Z1
<- ok
-> G91 G0 Z10000
<- error: no z axis is that long
-> G90 G81 X0 Y0 Z0 R1e5
<- error: no z axis is that long: R or Z
-> G91 G81 X0 Y0 Z-9000 R-9000
<- error: no z axis is that long: R or Z
-> G90 G80
<- ok
~~ wait 4
~~ z 1 0.02
; A limit that was set still ends a move; a number beyond all machines is refused all the same.
-> B17
<- B17
<- Upper limit set to: 1.00 within 0.021
<- ok
-> G0 Z5
<- ok
-> G0 Z1e5
<- error: that is farther than any machine reaches: Z
-> G49
<- ok
~~ wait 3
~~ z 1 0.03
-> B19
<* ok
; In a hold as well.
-> G1 X30 F600
~~ wait 1
>> ^H
~~ wait 1
-> G0 Z1e5
<- error: no z axis is that long
-> G91 G0 Z10000 G90
<- error: no z axis is that long
>> ~
<- ok
~~ wait 3
~~ z 1 0.03
; Words of a place where a code goes nowhere.
-> G4 P100 X10
<- error: G4 takes P or S and goes nowhere
-> G38.2 X5 Z-1
<- error: a probe goes along z, and takes no X or Y
~~ wait 1
~~ sled X30 Y0 within 0.06
