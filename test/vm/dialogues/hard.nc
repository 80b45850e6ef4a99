; The hard case: sag, stretch and pitch, all three axes in motion, first in one long move, then in
; short ones as fast as the line carries them.
<* ok
<* Settings are the defaults. Chain lengths are not known yet*
-> $7=2
<- ok
-> $8=139.1
<- ok
-> $29=1300
<- ok
-> $63=0.00137293
<- ok
-> $160=8.2e-12
<- ok
-> $170=5.2e-6
<- ok
-> $180=0.001
<- ok
-> $181=0.0008
<- ok
-> B06 L1710 R1710
<* position loaded at:
<* ok
-> G1 X5 Y0 F900
<- ok
~~ wait 10
-> G1 X305 Y-200 Z-10 F900
~~ wait 2
~~ measure 8
<- ok
~~ wait 2
-> G1 X5 Y0 Z0 F900
<- ok
~~ wait 2
~~ telemetry
~~ stream 600 z
~~ telemetry
~~ wait 5
