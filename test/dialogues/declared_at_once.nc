; A place that is declared right behind a new value of the frame is that of the new frame.
~~ include setup.inc
-> $2=3078.4
<- ok
-> G10 L20 P1 X0 Y0
<- ok
-> G0 X0 Y0
<- ok
~~ wait 2
~~ chains 1701.8 1701.8 within 0.1
