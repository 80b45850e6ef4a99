; A chain that was driven while its encoder did not count is not known.
~~ include setup.inc
~~ wait 4
~~ unplug left
-> B11 S255 T3 L
<* The left motor hardly turns*
<- ok
~~ plug left
-> G0 X10
<* ALARM: Halted at G0 X10: Position Lost*
