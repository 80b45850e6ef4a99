; Short moves as fast as the line carries them, for a sender of Grbl: first it asks nothing, then it
; asks ten times a second where the machine is.
<* ok
<* Settings are the defaults. Chain lengths are not known yet*
-> $7=2
<- ok
-> $8=139.1
<- ok
-> B06 L1710 R1710
<* position loaded at:
<* ok
-> G1 X5 Y0 F900
<- ok
~~ wait 20
>> ?
<* $131=1219.2
~~ stream 2000
~~ stream 2000 asked
~~ wait 5
