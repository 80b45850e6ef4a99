; Limits of z hold moves back without a word, and move along when z is declared anew.
~~ include setup.inc
-> B20
<- B20
<- Z Axis Upper Limit: NAN Lower Limit: NAN
<- ok
-> B17
<- B17
<- Upper limit set to: 0.00
<- ok
-> G0 Z-2
<- ok
-> B18
<- B18
<- Lower limit set to: -2.00 within 0.015
<- ok
-> G0 Z-5
<- ok
~~ wait 4
~~ z -2 within 0.02
-> G10 Z1
<- ok
-> B20
<- B20
<- Z Axis Upper Limit: 3.00 Lower Limit: 1.00 within 0.021
<- ok
-> B19
<- B19
<- Z Axis Limits Cleared
<- ok
-> G0 Z0.5
<- ok
~~ wait 4
~~ z -2.5 within 0.02
