; A hold in a dwell: the dwell's line is not answered before ~, so a sender's next line cannot be taken for the operator's.
~~ include setup.inc
-> G1 Z-3 F300
<- ok
~~ wait 8
-> G4 P2000
<- dwell time*
~~ wait 1
>> ^H
~~ wait 3
~~ quiet
>> ~
<- ok
-> G0 Z5
<- ok
~~ wait 14
~~ z 5 within 0.03
; What is behind the dwell in its line comes after ~.
-> $17=2
<- ok
-> G4 P1000 M3
<- dwell time*
~~ wait 0.5
>> ^H
~~ wait 2
~~ spindle low
>> ~
<- Turning Spindle On
<- ok
~~ spindle high
