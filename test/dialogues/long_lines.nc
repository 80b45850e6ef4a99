; A line that is too long is one error; many digits are no harm; lines come as fast as they can.
~~ include setup.inc
-> $70=1
<- ok
-> G1 X1.000000000000000000000000000000000000000000000000000000000000000000000000000000000000 Y1.5E0
<- ok
-> G1 X1 (a line that is longer than anything the machine has room for, as a macro might be, with more and more and more words in it so that it exceeds the two hundred and more characters that anybody would ever keep for one line of text on so small a machine; and then even more, for good measure, until it is over four hundred characters long, which nobody needs and nobody will ever read to its end, but here it comes)
<- error: *
-> G1 X2 Y2
<- ok
-> $0=2438.40000000000000000000000000
<- ok
-> $0=1e400
<- error: *
<- [Forward Calculating Position]
<- position loaded at:
<* *
<* *
~~ wait 2
~~ quiet
