; Every motor shield by its straps, and one that nobody knows.
~~ straps 61
<- PCB v1.0 Detected
~~ straps 62
<- PCB v1.1 Detected
~~ straps 63
<- PCB v1.2 Detected
~~ straps 52
<- PCB v1.3 TLE5206  Detected
~~ straps 4
<- PCB v1.4 TLE5206  Detected
~~ straps 6
<- PCB v1.5 TB6643  Detected
~~ straps 7
<- PCB v1.6 TLE9201  Detected
~~ straps 8
<- PCB v1.8 TB6643  Detected
~~ straps 12
<- ALARM: The Board version number from this Motor Control board is invalid. *
<* ok
-> B05
<* Firmware Version 1.28
<- ok
