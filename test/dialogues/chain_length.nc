; A shorter chain counts from the next move on, also if no other setting of the geometry was sent.
~~ include setup.inc
-> $70=1
<- ok
-> $10=1740
<- ok
-> G0 X100
<- error: no sled can hang there
-> G0 X20
<- ok
~~ wait 6
~~ sled X20 Y0 within 0.06
-> $10=3360
<- ok
~~ wait 1
<- [Forward Calculating Position]
<- position loaded at:
<- 20.00 within 0.02
<- 0.00 within 0.02
-> G0 X100
<- ok
~~ wait 8
~~ sled X100 Y0 within 0.06
