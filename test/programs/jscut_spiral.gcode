G21 ; Set units to mm
G90 ; Absolute positioning
G1 Z2.54 F2540 ; Move to clearance level

;
; Operation:    0
; Name:         washer
; Type:         Pocket
; Paths:        2
; Direction:    Conventional
; Cut Depth:    2
; Pass Depth:   1
; Plunge rate:  127 mm/min
; Cut rate:     1016 mm/min
;

; Path 0
; Rapid to initial position
G1 X-5.0000 Y-90.0000 F2540
G1 Z0.0000
; plunge
G1 Z-1.0000 F127
; cut
G1 X-5.0000 Y-90.0000 F1016
G1 X-4.0000 Y-93.0000
G1 X-1.0000 Y-95.0000
G1 X3.0000 Y-95.0000
G1 X6.0000 Y-93.0000
G1 X7.0000 Y-90.0000
G1 X6.0000 Y-87.0000
G1 X3.0000 Y-85.0000
G1 X-1.0000 Y-85.0000
G1 X-4.0000 Y-87.0000
G1 X-5.0000 Y-90.0000
; plunge
G1 Z-2.0000 F127
; cut
G1 X-4.0000 Y-93.0000 F1016
G1 X-1.0000 Y-95.0000
G1 X3.0000 Y-95.0000
G1 X6.0000 Y-93.0000
G1 X7.0000 Y-90.0000
G1 X6.0000 Y-87.0000
G1 X3.0000 Y-85.0000
G1 X-1.0000 Y-85.0000
G1 X-4.0000 Y-87.0000
G1 X-5.0000 Y-90.0000
; Retract
G1 Z2.5400 F2540
