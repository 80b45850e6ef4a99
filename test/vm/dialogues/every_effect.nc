; Every effect there is, a control tick of 5 ms: moves of 0.3 mm come out at the feed asked for.
<* ok
<* Settings are the defaults. Chain lengths are not known yet*
-> $7=2
<- ok
-> $8=139.1
<- ok
-> $100=4
<- ok
-> $110=0.007
<- ok
-> $111=0.02
<- ok
-> $120=2
<- ok
-> $121=2
<- ok
-> $130=1600
<- ok
-> $150=0.072
<- ok
-> $160=8.2e-12
<- ok
-> $170=5.2e-06
<- ok
-> $180=0.001
<- ok
-> $181=0.001
<- ok
-> $190=0.1
<- ok
-> $191=0.1
<- ok
-> $192=0.1
<- ok
-> $193=0.1
<- ok
-> $200=2
<- ok
-> $201=2
<- ok
-> $210=0.5
<- ok
-> $211=0.5
<- ok
-> $212=0.5
<- ok
-> $213=0.5
<- ok
-> $214=0.5
<- ok
-> $215=0.5
<- ok
-> $216=0.5
<- ok
-> $217=0.5
<- ok
-> $218=0.5
<- ok
-> $219=0.5
<- ok
-> $220=0.5
<- ok
-> $221=0.5
<- ok
-> $222=0.5
<- ok
-> $223=0.5
<- ok
-> $224=0.5
<- ok
-> $225=0.5
<- ok
-> $226=0.5
<- ok
-> $227=0.5
<- ok
-> $69=200
<- ok
~~ wait 2
~~ power cut
<* ok
-> B06 L1710 R1710
<* position loaded at:
<* ok
-> G1 X5 Y0 F1000
<- ok
~~ wait 3
~~ stream 150 0.3
~~ wait 1
