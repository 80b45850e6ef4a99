; B04 finds motors that turn, and one that does not.
~~ include setup.inc
~~ unplug right
-> B04
<- B04
<- Testing L motor:
<- Direction 1 - Pass
<- Direction 2 - Pass
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
