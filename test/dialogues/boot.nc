; What a fresh board says by itself, and that it says it soon enough.
<- PCB v1.2 Detected
<- FAKE_SERVO off
<- error: EEPROM read fail. Using default settings.
<- Grbl v1.00
<- Plumb *
<- ready
<- ok
<- [Forward Calculating Position]
<- Message: Unable to find valid machine position for chain lengths 0.00, 0.00*
~~ wait 1
~~ quiet
~~ status <Idle,MPos:0.00,0.00,0.00,WPos:0.000,0.000,0.000>
~~ errors [PE:0.00,0.00,127]
