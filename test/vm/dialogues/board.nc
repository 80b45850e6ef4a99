; What the board tells of itself, on a shield whose drivers report errors.
~~ straps 4
<* ok
<* Settings are the defaults. Chain lengths are not known yet*
~~ wait 1
~~ telemetry
~~ supply 4.1
<- The Mega's supply is low: *
~~ supply 5
~~ wait 1
~~ low 12
~~ wait 1
-> B11 L S100 T2
<* ALARM: The left motor's driver complains*
