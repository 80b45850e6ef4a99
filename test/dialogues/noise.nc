; Noise on the line, and a line without its beginning: errors at worst, and the next line works.
~~ include setup.inc
-> $70=1
<- ok
~~ answers from now
-> G1 X1 ÿþý Y1
-> XYZ
-> G
-> M
-> G1 X
~~ wait 2
-> $
-> $$$
-> $=5
-> $5
-> G99999999999 X5
~~ wait 2
-> G-1 X5
-> T
-> T-5
-> B
-> B0
~~ wait 2
-> B11 S9999 L
-> B06 L1e9
-> G1 X1e9
-> G2 I0 J0
-> G4 P1e30
~~ wait 2
~~ wait 9
~~ answers 20
-> G1 X0 Y0 F800
<- ok
~~ wait 2
~~ sled X0 Y0 within 0.06
