; The limits of z move along when the probe declares z.
~~ include setup.inc
-> G10 Z5
<- ok
-> B17
<* ok
~~ wait 3
~~ probe -3
-> G38.2 Z-10 F1
<* ok
-> B20
<- B20
<- Z Axis Upper Limit: 3.00 Lower Limit: NAN within 0.05
<- ok
