; The tests of the loops: nothing but numbers between the marks, and a stop ends each.
~~ include setup.inc
-> B13 L1 S5 F10 I2 V1
<- B13 L1 S5 F10 I2 V1
<- --PID Velocity Test Start--
<- Kp=5.0000,Ki=0.0000,Kd=0.2800
<* --PID Velocity Test Stop--
<- 
<- ok
-> B14 L1 S1 F-1 I2 T500 V2
<- B14*
<- --PID Position Test Start--
<- Kp=*
<- setpoint,input,output,rpminput,voltage
<* --PID Position Test Stop--
<- 
<- ok
-> B16 L1 S50 F60
<- B16 L1 S50 F60
<- --Voltage Test Start--
<* --Voltage Test Stop--
<- 
<- ok
-> B16 L1 S-255 F255
<- B16*
<- --Voltage Test Start--
~~ wait 1
>> !
<* ok
<* Laser off
<* position loaded at:
<* *
<* *
~~ off left
-> G0 X0 Y0
<- ok
~~ wait 1
