; B04 finds a motor that turns, one that turns the wrong way, and one that is not seen to turn.
~~ include setup.inc
~~ reverse left
~~ unplug right
-> B04
<- B04
<- Testing L motor:
<- Direction 1 - Fail
<- Direction 2 - Fail
<- Testing R motor:
<- Direction 1 - Fail
<- Direction 2 - Fail
<- Testing Z motor:
<- Direction 1 - Pass
<- Direction 2 - Pass
<- Tests complete.
<- ok
~~ off left
~~ off right
~~ off z
