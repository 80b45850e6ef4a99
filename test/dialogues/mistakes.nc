; A mistake anywhere in a line is one error, and nothing of the line is done.
~~ include setup.inc
-> $70=1
<- ok
-> G90 G1 X5 Y--5 F800
<- error: what follows is no number: Y*
-> G1 X5 Y
<- error: a number is missing behind Y*
-> G0 X5 G1 X1.2.3
<- error: what follows is no number: X*
-> G1 X1e99
<- error: a number is far too large: X*
-> G1 XNAN
<- error: a number is missing behind X*
-> G X5
<- error: a number is missing behind G*
-> G1.04 X5
<- error: there is no such code: G*
-> G91 X5 )
<- error: this begins no word: )*
-> X5 6
<- error: what follows is no number: X*
-> G1 X1/2
<- error: what follows is no number: X*
-> B06 L R
<- B06*
<- error: a number is missing behind L*
-> B09 L1.2.3 R0
<- B09*
<- error: what follows is no number: L*
-> B16 L1 S50000 F60
<- B16*
<- error: *
-> B14 L1 S0 F99999 I2 T100
<- B14*
<- error: *
-> B09 L16500 R1651
<- B09*
<- error: *
-> G10 Z1E30
<- error: *
-> $0=12--3
<- error: Bad number format
-> $0=1 2
<- error: Bad number format
-> G4 P10
<* dwell*
<- ok
~~ sled X0 Y0 within 0.05 mm
~~ z 0 0.01
-> G1 X 10 Y+1E+01 Q3 F800
<- ok
-> G4 P10
<* dwell*
<- ok
~~ sled X10 Y10 within 0.05 mm
; Two digits make a code.
-> BJ0
<- BJ0
<- error: *
; A setting has a number, which no sign makes smaller than none.
-> $=5
<- error: *
-> $-1=5
<- error: *
