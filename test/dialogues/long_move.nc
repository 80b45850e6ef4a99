; A move of a minute, a dwell of ten seconds: reports go on (the player watches for gaps).
~~ include setup.inc
-> G1 X60 F60
<- ok
~~ wait 61
~~ status <Idle,MPos:60.00,0.00,0.00,WPos:0.000,0.000,0.000> within 0.3
-> G4 P10000
<- dwell time 10.000 s
<- ok
-> G4 S2
<- dwell time 2.000 s
<- ok
