; Senders of Grbl that nobody had prepared for, by their first words, and Maslow's Stop between.
<* Grbl 1.1h ['$' for help]
<* ready
<- ok
<* Settings are the defaults. Chain lengths are not known yet*
; Candle, OpenBuilds CONTROL and grbl-streamer send 0x18 and wait for a line that begins with Grbl.
>> ^X
<* Grbl 1.1h ['$' for help]
<* ready
<- ok
<- Laser off
; gSender asks in words.
-> $I
<- [VER:1.1h.*
<- [OPT:V,16,128]
<- ok
-> B05
<* ok
; pygrbl-streamer unlocks before it asks anything.
-> $X
<- [MSG:Caution: Unlocked]
<- ok
-> B05
<* ok
; A dump that a question cuts begins again: the last number that comes is Grbl's.
-> $$
<- $0=2438.4 (*
>> ?
<* $131=1219.2
<* $10=1
<* $110=900
<* $131=1219.2
<* $1227=0 (*
<- ok
; Lines end in CR, LF or both, and each is answered once; so is what ends a quick character.
~~ answers from now
>> G90^MG91^M^NG90 ^M ^NG21^N^M^N
~~ wait 0.5
~~ answers 5
