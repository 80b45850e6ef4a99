; A stop in the pause for a tool: the tool was not put in, so it is asked for again.
~~ include setup.inc
-> T2 M6
<- Tool change to tool 2
<- Tool Change: Please insert tool 2
<- Maslow Paused
~~ wait 1
>> !
<* position loaded at:
<* *
<* *
~~ wait 2
-> T2 M6
<* Tool Change: Please insert tool 2
<- Maslow Paused
>> ~
<- ok
<- ok
