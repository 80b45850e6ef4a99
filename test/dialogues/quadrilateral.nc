; The sled with two brackets, which is the published default.
<* ready
<- ok
<* Settings are the defaults. Chain lengths are not known yet*
-> B08
<- B08
<* position loaded at:
<- 0.00 within 0.05
<* *
<* Message: The machine chains*
<- ok
-> G0 X100
<- ok
~~ wait 10
~~ status <Idle,MPos:100.00,*
