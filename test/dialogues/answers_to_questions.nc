; A ~ answers what was asked: one that ends a hold is no answer to a pause that comes later.
~~ include setup.inc
>> G1 X5 F300^NG1 X6^NT2 M6^NG1 Z-3^N
~~ wait 0.3
>> ^H
~~ wait 0.5
>> ~
~~ wait 0.3
>> ~
<* Tool Change: Please insert tool 2
<- Maslow Paused
~~ wait 5
~~ z 0 within 0.03
~~ status <Pause,*
>> ~
<- ok
<- ok
~~ wait 9
; The same for M0, where a ~ alone would count.
>> G1 X10 F300^NM0^N
<- ok
~~ wait 0.5
>> ^H
~~ wait 0.5
>> ~
~~ wait 0.3
>> ~
<* Maslow Paused
~~ wait 3
~~ status <Pause,*
>> ~
<- ok
<- ok
; A hold while the spindle stops for a new tool: its ~ is no answer either.
-> $17=2
<- ok
-> T3 M6
<- Tool change to tool 3
<- Turning Spindle Off
~~ wait 0.3
>> ^H
~~ wait 2
~~ quiet
>> ~
<- Tool Change: Please insert tool 3
<- Maslow Paused
~~ wait 2
~~ quiet
>> ~
<- ok
<- ok
