; Lines of a sender that runs ahead wait; the operator's lines that come later pass them by.
~~ include setup.inc
>> G1 Z-2 F300^NT1 M6^NG1 X20 F900^NG1 X40^N
<- ok
<- Tool change to tool 1
<- Tool Change: Please insert tool 1
<- Maslow Paused
~~ wait 1
-> G0 Z2
<- ok
~~ wait 10
~~ z 2 within 0.03
-> B10 L
<- B10L
<- [Measure: *
<- ok
; What would move the sled, or else change the program, is refused and says why.
-> G91 G0 X30 G90
<- error: the program waits: answer it with ~ or !; until then only z, its zero and questions
-> G38.2 Z-30
<- error: the program waits: answer it with ~ or !; until then only z, its zero and questions
-> M3
<- error: the program waits: answer it with ~ or !; until then only z, its zero and questions
~~ wait 2
~~ sled X0 Y0 within 0.06
>> ~
<- ok
<- Z goes back to -2.00
<- ok
<- ok
<- ok
~~ wait 4
~~ sled X40 Y0 within 0.06
~~ z -2 within 0.03
; In M0, with 126 characters of the sender in their room.
>> M0^NG1 X38 (a)^NG1 X36 (b)^NG1 X34 (c)^NG1 X32 (d)^NG1 X30 (e)^NG1 X28 (f)^NG1 X26 (g)^NG1 X24 (h)^NG1 X22 (i)^NG1 X20^N
<- Maslow Paused
~~ wait 1
-> G0 Z1 (with a comment, so that it would never fit beside them)
<- ok
~~ wait 6
~~ z 1 within 0.03
-> G91 G0 X30 G90
<- error: the program waits: *
; A line that is half there when ~ comes is too late.
>> G0 Z5~0^N
<- ok
<- Z goes back to -2.00
<- error: the program went on before this line; send it again
<- ok
~~ wait 15
~~ answers from now
~~ sled X20 Y0 within 0.06
~~ z -2 within 0.03
