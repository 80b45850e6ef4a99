; A client's correction on top of the same one of this firmware: the machine adds them, and says so.
~~ include setup.inc
; Stretch has a single carrier: WebControl's $45 is $170. Neither has one side alone.
-> $45=5.2e-6
<- ok
-> $40=0.2
<- ok
-> $181=0.002
<- ok
~~ wait 1
<- [Forward Calculating Position]
<- position loaded at:
<* *
<* *
; Sag is in $160 already. A client sends its numbers one after the other: one line for all of them.
-> $37=8.2 
<- ok
-> $180=0.002
<- ok
~~ wait 1
<- Corrected twice: the machine adds $37 to $160, $40 to $180. Set one of each pair to 0, in your client too.
<- [Forward Calculating Position]
<- position loaded at:
<* *
<* *
; Once, also when other values change.
-> $3=463.1
<- ok
-> $37=8.3
<- ok
~~ wait 1
<- [Forward Calculating Position]
<- position loaded at:
<* *
<* *
; A pair more.
-> $41=-0.1
<- ok
~~ wait 1
<- Corrected twice: the machine adds $37 to $160, $40 to $180, $41 to $181. Set one of each pair to 0, in your client too.
<- [Forward Calculating Position]
<- position loaded at:
<* *
<* *
; Cured, and set again: said again, before a move that comes at once.
-> $37=0
<- ok
-> $180=0
<- ok
-> $41=0
<- ok
~~ wait 1
<- [Forward Calculating Position]
<- position loaded at:
<* *
<* *
-> $37=8.2
<- ok
-> G0 X0 Y0
<- Corrected twice: the machine adds $37 to $160. Set one of each pair to 0, in your client too.
<- ok
~~ wait 8
~~ off left
; At each start, before the clients are asked to send.
~~ power
<- PCB v1.2 Detected
<- FAKE_SERVO off
<- Corrected twice: the machine adds $37 to $160. Set one of each pair to 0, in your client too.
<- Plumb v*
<* ready
<- ok
<- [Forward Calculating Position]
<- position loaded at:
<* *
<* *
~~ wait 1
~~ quiet
; All to the defaults forgets it; the same two are news again.
-> $RST=$
<- Message: Restoring defaults 
<* ok
~~ wait 1
<* position loaded at:
<* *
<* *
-> $7=2
<- ok
-> $37=8.2
<- ok
-> $160=8.2e-12
<- ok
~~ wait 1
<- Corrected twice: the machine adds $37 to $160. Set one of each pair to 0, in your client too.
<* position loaded at:
<* *
<* *
; A sled on two brackets has neither: the published numbers count for the ring alone.
-> $7=1
<- ok
-> $40=0.1
<- ok
-> $180=0.001
<- ok
~~ wait 1
<- [Forward Calculating Position]
<- position loaded at:
<* *
<* *
