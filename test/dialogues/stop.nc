; Stop in a move: one ok at once, nothing more is owed, the next command works.
~~ include setup.inc
-> G1 X300 F500
<- ok
-> G1 X0
<- ok
~~ wait 3
>> !
<- ok
<- Laser off
<- [Forward Calculating Position]
<- position loaded at:
<* *
<* *
~~ wait 3
~~ quiet
~~ off left
-> G91 G0 Y10 G90
<- ok
~~ wait 4
-> G0 X0 Y0
<- ok
~~ wait 8
~~ sled X0 Y0 within 0.06
; In a dwell, too.
-> G4 P20000
<- dwell *
~~ wait 2
>> !^N
<- ok
<* position loaded at:
<* *
<* *
-> G90
<- ok
~~ wait 1
~~ quiet
; Before a pause whose moves are on their way: nobody is asked for anything.
-> G1 X40 F600
<- ok
-> M0
~~ wait 0.5
>> !
<- ok
<- Laser off
<- [Forward Calculating Position]
<- position loaded at:
<* *
<* *
~~ wait 2
~~ quiet
