; Arcs of few decimals: each ends where its line says, however its numbers were rounded.
~~ include setup.inc
-> G20
<- ok
-> G1 X0 Y0 F30
<- ok
; Radii that differ by a twentieth of the way.
-> G3 X0.018 Y-0.009 I0.541 J1.080
<- ok
; Ends in one place, about a centre that is no farther than text can tell.
-> G2 X0.018 Y-0.009 I0.002 J-0.001
<- ok
; Ends rounded past each other: no turn of 300 mm.
-> G3 X0.017 Y-0.009 I0 J1.965
<- ok
; The centre fell on the start.
-> G3 X0.018 Y-0.008 I0 J0
<- ok
; By its radius, half a turn whose ends are farther apart than the circle is wide.
-> G2 X0.018 Y0.492 R0.249
<- ok
-> G4 P0
<* ok
~~ wait 1
~~ sled X0.4572 Y12.4968 within 0.06
; A negative radius is the long way round, also where the ends are near: 1.26 inches at 30 a minute.
-> G2 X0.0181 Y0.492 R-0.2
~~ wait 1
~~ sled X-3 Y21 within 3
<- ok
-> G4 P0
<* ok
~~ wait 1
~~ sled X0.4597 Y12.4968 within 0.06
-> G21
<- ok
; What is no arc by any rounding is not done.
-> $70=1
<- ok
-> G2 X20 Y20 I5 J2
<- error: the arc does not end on its circle
-> G2 X20 Y20 R5
<- error: an arc of that radius does not reach its end
-> G2 R5
<- error: an arc of that radius does not reach its end
