; A file as programs write it: line numbers, comments, inches, missing spaces, small letters.
~~ include setup.inc
-> %
<- ok
-> (made by hand)
<- ok
-> N10 G20 G90 G17 G40 G49 G80 G94 G54
<- ok
-> N20 g0z0.1
<- ok
-> N30G0X1Y1
<- ok
-> N40 G1 Z-.05F20
<- ok
-> G1X2F30
<- ok
-> X2 Y2
<- ok
-> G2 X3 Y1 I1 J0 ; quarter
<- ok
-> G3X2.Y0.R1.
<- ok
-> G1 X +1 Y 0
<- ok
-> G0 Z.1
<- ok
-> M5
<- ok
-> M30
<- ok
-> %
<- ok
~~ wait 40
~~ sled X25.4 Y0 within 0.06
~~ z 2.54 within 0.02
-> G91.1
<- ok
-> M8
<- Command M8 unsupported and ignored.
<- ok
