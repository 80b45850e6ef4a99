; Bytes by which senders of Grbl command are no text: those this machine knows act, the others are
; dropped, alone and behind 0xC2.
~~ include setup.inc
-> $70=0
<- ok
>> • Â
-> G0 X1
<- ok
>> Â‘
<- [Feed: 110 %]
>> Â
<- [Feed: 100 %]
-> G1 X30 F600
~~ wait 2
; The hold behind a byte that means nothing.
>> …„
~~ wait 1
~~ status <Pause,MPos:*
>> ~
<- ok
~~ wait 3
~~ sled X30 Y0 within 0.06
; Within a line they are dropped as well; a wrong bit in a digit still is a mistake.
>> G1 •X2Â€5 F800^N
<- ok
~~ wait 2
~~ sled X25 Y0 within 0.06
>> G1 X1°^N
<- ALARM: Halted at G1 X1?*
>> !
<- ok
<* position loaded at:
<* *
<* *
