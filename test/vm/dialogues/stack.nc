; The stack runs into the data while the main program never comes back: the tick lets go at once.
<* ok
<* Settings are the defaults. Chain lengths are not known yet*
-> $7=2
<- ok
-> $8=139.1
<- ok
-> B06 L1710 R1710
<* position loaded at:
<* ok
~~ wait 2
-> M106
<* ok
-> G1 X500 Y0 F600
~~ wait 2
~~ on left at once
~~ on right at once
~~ laser high at once
~~ freeze report
~~ overrun stack
~~ wait 0.05
~~ off left at once
~~ off right at once
~~ laser low at once
~~ wake 6
<- ALARM: The firmware's stack ran into its data. Switch the Mega off and on*
; Stop does not help, and nothing is believed.
-> !
<- ok
<- ALARM: The firmware's stack ran into its data*
-> G1 X0 Y0
~~ wait 1
~~ off left at once
~~ off right at once
~~ power
<* ALARM: Position Lost. The firmware's stack had run into its data.*
; At rest as well, with the position kept.
-> B06 L1710 R1710
<* position loaded at:
<* ok
~~ wait 2
~~ overrun stack
<- ALARM: The firmware's stack ran into its data*
~~ wait 1
~~ power
<* ALARM: Position Lost. The firmware's stack had run into its data.*
