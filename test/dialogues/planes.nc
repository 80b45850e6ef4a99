; Arcs that turn z: G18 turns from z to x, G19 from y to z.
~~ include setup.inc
-> $70=1
<- ok
-> G0 X10 Y10 Z2
<- ok
; A lead-in: down along a quarter of a circle, then up along the other.
-> G18 G3 X12 Z0 I2 K0 F800
<- ok
-> G4 P300
<* ok
~~ sled X12 Y10 within 0.06
~~ z 0 within 0.02
-> G2 X14 Z2 R1
<- error: an arc of that radius does not reach its end
-> G3 X14 Z2 R2
<- ok
-> G4 P300
<* ok
~~ sled X14 Y10 within 0.06
~~ z 2 within 0.02
; In G19, with y; as a helix along x; and with centres as places.
-> G19 G2 Y14 J2 K0
<- ok
-> G4 P300
<* ok
~~ sled X14 Y14 within 0.06
~~ z 2 within 0.02
-> G90.1 G3 X20 Y10 J12 K2
<- ok
-> G4 P300
<* ok
~~ sled X20 Y10 within 0.06
~~ z 2 within 0.02
; A full circle comes back; inches and G91 count.
-> G91.1 G18 G2 K-1
<- ok
-> G20 G91 G3 Z-0.1 X0.1 I0.1
<- ok
-> G21 G90 G4 P300
<* ok
~~ sled X22.54 Y10 within 0.06
~~ z -0.54 within 0.02
; Without any word it is a mode alone.
-> G18 G3
<- ok
; What is no such arc.
-> G3 X30 Z2 I3 K0
<- error: the arc does not end on its circle
-> G3 X30 Z2 J3
<- error: an arc needs R, or a centre in its plane (G17 to G19)
-> G90.1 G3 X30 Z2 I25
<- error: with G90.1 an arc needs both letters of its centre
-> G91.1 G53 G3 X30 Z-0.54 I3.73 K0
<- error: G53 goes with G0 and G1 only
-> $16=0
<- ok
-> G3 X30 Z-0.54 I3.73 K0
<- error: an arc after G18 or G19 needs a motor for z
-> G17 G4 P0
<* ok
~~ sled X22.54 Y10 within 0.06
~~ z -0.54 within 0.02
