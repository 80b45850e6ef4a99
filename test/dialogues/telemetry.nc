; B30 tells how the machine is doing in a line that clients pass over; the board is watched.
~~ include setup.inc
; A new board stores its settings first, and says "writing" until then.
~~ wait 4
-> B30
<- B30
<- [Telemetry|error:0.000,0.000,0.000|dry:0|tick:#|illegal:0,0,0|supply:5.00,5.00|eeprom:ok|start:usual|events:0,0,0,0|last:none,0|slips:0,0|slipped:none,0,0,0] within 0.03
<- ok
; What it tells is what happened since it was last asked.
-> G1 X50 Y0 F600
<* ok
-> G4 P0
<* ok
-> B30
<- B30
<- [Telemetry|error:0.300,0.300,0.000|dry:0|tick:#|illegal:0,0,0|supply:5.00,5.00|eeprom:ok|start:usual|events:0,0,0,0|last:none,0|slips:0,0|slipped:none,0,0,0] within 0.299
<- ok
~~ wait 1
-> B30
<- B30
<- [Telemetry|error:0.000,0.000,0.000|dry:0|tick:#|illegal:0,0,0|supply:5.00,5.00|eeprom:ok|start:usual|events:0,0,0,0|last:none,0|slips:0,0|slipped:none,0,0,0] within 0.03
<- ok
; The supply sags: said once, told as the lowest.
~~ supply 4.2
<- The Mega's supply is low: 4.25 V. Check its plug and USB cable ($76). within 0.05
~~ wait 2
~~ supply 4.35
~~ wait 2
~~ supply 4.2
~~ wait 2
~~ supply 5
~~ wait 2
-> B30
<- B30
<- [Telemetry|error:0.000,0.000,0.000|dry:0|tick:#|illegal:0,0,0|supply:5.00,4.20|eeprom:ok|start:usual|events:0,0,1,0|last:supply,1|slips:0,0|slipped:none,0,0,0] within 0.03
<- ok
-> B30
<- B30
<- [Telemetry|error:0.000,0.000,0.000|dry:0|tick:#|illegal:0,0,0|supply:5.00,5.00|eeprom:ok|start:usual|events:0,0,1,0|last:supply,1|slips:0,0|slipped:none,0,0,0] within 0.03
<- ok
; Once more after it was back, and never with $76=0.
~~ supply 4.2
<- The Mega's supply is low: 4.25 V. Check its plug and USB cable ($76). within 0.05
~~ supply 5
~~ wait 1
-> $76=0
<- ok
~~ supply 3.5
~~ wait 1
~~ supply 5
; How often it happened, ever, is kept without power.
~~ power cut
<* ok
<* *
~~ wait 1
-> B30
<* B30
<- [Telemetry|error:0.000,0.000,0.000|dry:0|tick:#|illegal:0,0,0|supply:5.00,5.00|eeprom:ok|start:usual|events:0,0,2,0|last:supply,2|slips:0,0|slipped:none,0,0,0] within 0.03
<- ok
