; $RST erases settings, and what else its letter says.
~~ include setup.inc
-> $15=700
<- ok
-> $RST=$
<- Message: Restoring defaults 
<- Laser off
<* Plumb v*
<* ok
<* position loaded at:
<* *
<* *
~~ wait 2
-> $$
<* $15=900 (*
<* ok
-> B10 L
<- B10 L
<- [Measure: *
<- ok
-> $RST=*
<- Message: Restoring defaults 
<* ok
<* Settings are the defaults. Chain lengths are not known yet*
~~ wait 8
~~ power cut
<* ok
<- Chain lengths are not known yet*
~~ wait 2
-> $7=2
<- ok
-> $8=139.1
<- ok
-> B06 L1710 R1710
<* position loaded at:
<* *
<* *
<- ok
-> $RST=#
<- Message: Restoring defaults 
<* ok
<* Settings are the defaults. Chain lengths are not known yet*
; The place is that of the default frame again.
-> B06 L1710 R1710
<* position loaded at:
<- 0.00
<- -125.07 within 0.05
<- ok
-> $RST=x
<- error: *
; That motors run in imagination is forgotten by the star alone.
-> B99 ON
<* ok
-> $RST=#
<- Message: Restoring defaults 
<* FAKE_SERVO on
<* Settings are the defaults. Chain lengths are not known yet*
-> $RST=*
<- Message: Restoring defaults 
<* FAKE_SERVO off
<* Settings are the defaults. Chain lengths are not known yet*
