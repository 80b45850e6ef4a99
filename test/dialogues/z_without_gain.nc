; A machine that no client has told: z does not lag in silence, it halts by name.
~~ include setup.inc
-> $29=0
<- ok
-> G1 X5 Z-3 F800
<- ALARM: Halted at G1 X5 Z-3 F800: z does not follow while $29 is 0: connect your client, or send $29=1300. Press Stop.
>> !
<- ok
<* position loaded at:
<* *
<* *
-> $70=1
<- ok
-> G38.2 Z-5
<- error: z does not follow while $29 is 0*
-> G81 X5 Z-1 R1
<* error: z does not follow while $29 is 0*
-> G80
<- ok
-> G1 X30 F600
~~ wait 1
>> ^H
~~ wait 1
-> G0 Z2
<- error: z does not follow while $29 is 0*
>> ~
<- ok
~~ wait 4
~~ sled X30 Y0 within 0.06
~~ z 0 0.01
; With its gain it goes.
-> $29=1300
<- ok
-> G1 Z-1
<- ok
~~ wait 3
~~ z -1 0.02
