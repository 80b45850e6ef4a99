; Exactly one answer for each line, whatever it is.
~~ include setup.inc
-> 
<- ok
->   
<- ok
-> ; only a comment
<- ok
-> (only a comment)
<- ok
-> %
<- ok
-> G17 G40 G94
<- ok
-> g1x1y2f300
<- ok
-> $9x
<- error: *
-> $14=3
<- error: *
-> $300=1
<- error: *
-> B5
<- B5
<- error: *
-> B77
<- B77
<- error: *
-> N10 G1 X0 Y0
<- ok
-> M2
<- ok
~~ wait 2
~~ quiet
; The end of a line behind a quick character is not a line.
>> ~^N
<- ok
>> !^N
<- ok
<- Laser off
<* position loaded at:
<- 0.00 within 0.05
<- 0.00 within 0.05
~~ wait 1
~~ quiet
