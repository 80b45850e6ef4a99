; $RST erases settings, and what else its letter says.
~~ include setup.inc
-> $15=700
<- ok
-> $RST=$
<- Message: Restoring defaults 
<- Laser off
<* Grbl v1.00
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
~~ wait 2
-> $RST=x
<- error: *
