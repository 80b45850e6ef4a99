; Arcs by centre and by radius, helix, inch units, all ending where they should.
~~ include setup.inc
-> $70=1
<- ok
-> G1 X50 Y0 F800
<- ok
-> G2 X0 Y-50 I-50 J0
<- ok
-> G3X50Y0R50
<- ok
-> G3 X50 Y0 I-20 J0 Z-1
<- ok
-> G2 X70 Y20 R-20
<- ok
-> G4 P0
<* ok
~~ wait 1
~~ sled X70 Y20 within 0.06
~~ z -1 within 0.02
-> G2 X200 Y200 R10
<- error: *
; G90.1: the centre is a place.
-> G0 X0 Y0
<- ok
-> G90.1 G2 X0 Y10 I0 J5
<- ok
-> G91.1 G4 P0
<* ok
~~ wait 0.5
~~ sled X0 Y10 within 0.06
; An arc's line needs no place, and none of I and J: a full circle. The sled is seen on it: below
; the circle's start, then to the right of it.
-> G3 X0 Y0 J-5
<- ok
-> J-5
<- ok
~~ sled X3 Y-9 within 3
~~ errors [PE:0.00,0.00,127] within 0.6
-> I5
<- ok
~~ sled X9 Y3 within 3
-> G4 P0
<* ok
~~ wait 0.5
~~ sled X0 Y0 within 0.06
