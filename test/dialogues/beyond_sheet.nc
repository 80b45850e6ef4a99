; Beyond the sheet the sled waits at its edge; the program goes on counting.
~~ include setup.inc
-> G0 Y620
<- ok
~~ wait 50
~~ sled X0 Y609.6 within 0.06
~~ status <Idle,MPos:0.00,620.00,0.00,WPos:0.000,0.000,0.000> within 0.05
-> G0 Y600
<- ok
~~ wait 4
~~ sled X0 Y600 within 0.06
