; The firmware as flashed: boot, settings, version, a setting kept over a reset, a move.
<- PCB v1.2 Detected
<- FAKE_SERVO off
<- Plumb v*
<* ready
<- ok
<- Settings are the defaults. Chain lengths are not known yet*
-> $$ 
<- $0=2438.4 (*
<* $42=2 (*
<* $227=0 (*
<- ok
-> B05  
<- B05
<- Firmware Version 1.28
<- ok
-> $7=2
<- ok
-> $8=139.1
<- ok
-> $15=700
<- ok
-> B08
<* Message: The machine chains have been manually re-calibrated.
<- ok
-> G91
<- ok
-> G1 Y-20 X10 F700
<- ok
~~ wait 4
~~ paid left
~~ paid right
-> G1 Y20 X-10
<- ok
~~ wait 3
~~ wound left
~~ wound right
-> G90
<- ok
~~ wait 3
~~ power cut
<- PCB v1.2 Detected
<- FAKE_SERVO off
<* ready
<- ok
<- [Forward Calculating Position]
<- position loaded at:
<- 0.00 within 0.05
<* *
-> $$
<* $15=700 (*
<* $227=0 (*
<- ok
