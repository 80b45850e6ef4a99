; Every effect there is, a control tick of 5 ms: moves of 0.3 mm come out at the feed asked for.
~~ include every_effect.inc
-> G1 X5 Y0 F1000
<- ok
~~ wait 3
~~ stream 150 0.3
~~ wait 1
