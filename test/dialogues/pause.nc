; M0 waits for ~, which gets its own ok first; a tool change names the tool once.
~~ include setup.inc
-> G1 X20 F800
<- ok
-> M0 
<- Maslow Paused
~~ wait 2
~~ status <Pause,MPos:20.00,0.00,0.00,WPos:0.000,0.000,0.000> within 0.05
~~ quiet
>> ~^N
<- ok
<- ok
-> T2 M6
<- Tool change to tool 2
<- Tool Change: Please insert tool 2
<- Maslow Paused
>> ~
<- ok
<- ok
-> M6 T2
<- Tool change to tool 2
<- ok
-> M1
<- Maslow Paused
~~ wait 1
-> B17
<- B17
<- Upper limit set to: 0.00 within 0.015
<- ok
-> B19
<- B19
<- Z Axis Limits Cleared
<- ok
~~ wait 65
~~ on left
>> !
<- ok
<* position loaded at:
<* *
<* *
-> G0 X0
<- ok
~~ wait 4
~~ quiet
; WebControl's ~ comes while the moves before the pause still run: it counts.
-> G1 X20 F800
<- ok
-> M0 
~~ wait 0.2
>> ~
<- ok
<- Maslow Paused
<- ok
