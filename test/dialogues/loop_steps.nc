; Every step of B14 is driven, also when the steps together last longer than the rest after which motors are let go.
~~ include setup.inc
-> B14 L1 S0 F-6 I4 V2
<- B14*
<* --PID Position Test Start--
~~ wait 5
~~ on left
<* --PID Position Test Stop--
<- 
<- ok
~~ chains 1695.79 1701.79 0.05
