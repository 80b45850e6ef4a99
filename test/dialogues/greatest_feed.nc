; A smaller greatest feed counts from the next move on, also while the operator's override raises the feed.
~~ include setup.inc
-> G1 X10 F400
<- ok
>> ^1^1^1^1^1^1^1^1^1^1^1
<* [Feed: 200 %]
~~ wait 4
-> $15=500
<- ok
-> G1 X110
~~ wait 6.5
~~ status <Idle,MPos:60.00,0.00,0.00,WPos:0.000,0.000,0.000> within 8
<- ok
~~ wait 8
~~ sled X110 Y0 within 0.06
