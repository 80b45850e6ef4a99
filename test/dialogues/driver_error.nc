; A driver reports an error on its pin, as those of shields v1.3 and v1.4 can.
~~ shield 3
~~ include setup.inc
; A driver's complaint halts a machine whose motors are on, not one at rest.
~~ wait 3
~~ complain right
~~ wait 1
~~ quiet
-> G1 X50 F600
<* ALARM: The right motor's driver complains*
~~ off left
~~ off right
; B30 is answered meanwhile.
-> B30
<* B30
<- [Telemetry|error:#,#,#|dry:#|tick:#|illegal:0,0,0|supply:#,#|eeprom:ok|start:usual|events:0,0,0,1|last:driver,1|slips:0,0|slipped:none,0,0,0]
<* ok
