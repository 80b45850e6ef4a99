; B11 pulls a chain across the motors until it is tight, three times, and says the motor gap. It never takes longer than T.
~~ include setup.inc
~~ hook left 5
-> B06 L2996.1 R1700
<- B06 L2996.1 R1700
<* ok
-> $42=2000
<- ok
-> B11 S255 T15 L
<- B11 S255 T15 L
<- Motor gap # mm before sag and flex, spread #*
<* ok
~~ wait 0.3
~~ off left
-> B10 L
<- B10 L
<- [Measure: 2990] within 13
<- ok
; As a client sends it; the chain is tight before it begins.
-> B11 S255 T3 L
<- B11 S255 T3 L
<- Motor gap # mm before sag and flex, spread #*
<* ok
~~ quiet
; Far from tight.
~~ hook left 60
-> B06 L3051.1 R1700
<- B06 L3051.1 R1700
<* ok
-> B11 S255 T3 L
<- B11 S255 T3 L
<* ok
~~ quiet
~~ wait 0.3
~~ off left
; A stop in a pull.
-> B11 S255 T15 L
<- B11 S255 T15 L
~~ wait 1
~~ on left
>> !^N
<- ok
<* Laser off
~~ wait 0.5
~~ off left
; An encoder that is no longer heard, or a motor that cannot turn: the motor is driven for 0.6 s at most.
~~ hook left 5
-> B06 L2996.1 R1700
<* ok
~~ unplug left
-> B11 S255 T15 L
<* The left motor hardly turns: check its supply, its cables and its encoder.
<- ok
~~ wait 0.3
~~ off left
~~ plug left
~~ block left
-> B11 S255 T15 L
<* The left motor hardly turns: check its supply, its cables and its encoder.
<- ok
~~ free left
~~ wait 0.3
~~ off left
; Half a second is too short to measure: a gentle pull.
-> B11 S255 T0.5 L
<* B11 S255 T0.5 L
<- ok
