; A sled that was moved while its motors were off: neither the probe nor chains by themselves go on from there unasked.
~~ include setup.inc
~~ probe -3
~~ pull left 10
<- The sled moves while its motors are off.
~~ wait 3
~~ pull left 0
~~ wait 1
-> $70=1
<- ok
-> G38.2 Z-5
<- error: the sled moved # mm while its motors were off: bring it back, or begin again from where it is
-> B09 L1700
<- B09 L1700
<- error: the sled moved # mm while its motors were off: bring it back, or begin again from where it is
-> B15
<- B15
<- error: the sled moved # mm while its motors were off: bring it back, or begin again from where it is
~~ wait 1
~~ off left
-> $70=0
<- ok
-> B15
<- B15
<- ALARM: Halted at B15: the sled moved # mm while its motors were off*
>> !
<- ok
<* position loaded at:
<* *
<* *
; After Stop the sled belongs where it is.
-> G38.2 Z-5
<* z axis zeroed
<- ok
-> B15
<* position loaded at:
<- 0.00 within 0.1
<- 0.00 within 0.1
<- ok
