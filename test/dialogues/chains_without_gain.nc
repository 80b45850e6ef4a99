; Chains whose position loop has no gain do not follow: nothing that moves them begins. z goes on.
~~ include setup.inc
-> $21=0
<- ok
-> G1 X5 F800
<- ALARM: Halted at G1 X5 F800: the chains do not follow while $21 is 0: connect your client, or send $21=1300. Press Stop.
>> !
<- ok
<* position loaded at:
<* *
<* *
-> $70=1
<- ok
-> G2 X10 Y0 I5 J0
<- error: the chains do not follow while $21 is 0*
-> G91 G0 X1 G90
<- error: the chains do not follow while $21 is 0*
-> G81 X5 Z-1 R1
<* error: the chains do not follow while $21 is 0*
-> G80
<- ok
-> B02 L1
<- B02 L1
<- error: the chains do not follow while $21 is 0*
-> B09 L1700
<- B09 L1700
<- error: the chains do not follow while $21 is 0*
-> B15
<- B15
<- error: the chains do not follow while $21 is 0*
-> G0 Z2
<- ok
~~ wait 5
~~ z 2 0.02
~~ sled X0 Y0 within 0.1
-> $21=1300
<- ok
-> G1 X10
<- ok
~~ wait 3
~~ sled X10 Y0 within 0.06
