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
~~ on
~~ laser high
~~ hang report
~~ overrun stack
~~ wait 0.05
~~ off
~~ laser low
~~ wake 6
<- ALARM: The firmware's stack ran into its data. Switch the Mega off and on*
; Stop does not help, and nothing is believed.
-> !
<- ok
<- ALARM: The firmware's stack ran into its data*
-> G1 X0 Y0
~~ wait 1
~~ off
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
