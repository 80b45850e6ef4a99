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
