; WebControl's ~ comes as soon as M0 is sent, while the moves before it have far to go: it counts.
~~ include setup.inc
>> G1 X200 F900^NM0 ^N
~~ wait 0.06
>> ~
<- ok
<- ok
<- Maslow Paused
<- ok
; For one pause alone, and not for lines that come later.
>> G1 X180^NM1^NM0^N~
<- ok
<- ok
<- Maslow Paused
<- ok
<- Maslow Paused
~~ wait 1
~~ quiet
>> ~
<- ok
<- ok
>> ~
<- ok
-> M0
<- Maslow Paused
~~ wait 1
~~ quiet
>> ~
<- ok
<- ok
; Not for a tool change: nobody has changed a tool before the machine asks for it.
>> G1 X200^NM6 T2^N~
<- ok
<- ok
<- Tool change to tool 2
<- Tool Change: Please insert tool 2
<- Maslow Paused
~~ wait 1
~~ quiet
>> ~
<- ok
<- ok
