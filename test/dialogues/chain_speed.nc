; A chain speed that no gearbox does is refused, by the sprocket that the machine has.
~~ include setup.inc
-> $68=1270
<- ok
-> $68=1271
<- error: $68 must be at most 1270: the gearbox turns a sprocket 20 times a minute at most
-> $13=60
<- ok
-> $68=1201
<- error: $68 must be at most 1200: *
-> $68=1200
<- ok
