; 0x84 and the ~ that ends it leave the count of answers alone: a sender that fills the room with 126 characters may hold and go on as often as it likes.
~~ include setup.inc
~~ answers from now
>> G1 X12.3456 F300^NG1 X2.3456 (aa)^NG1 X3.3456 (bb)^NG1 X4.3456 (cc)^NG1 X5.3456 (dd)^NG1 X6.3456 (ee)^NG1 X7.3456 (ff)^N
~~ wait 0.5
>> ^H
~~ wait 0.5
>> ~
~~ wait 0.5
>> ^H
~~ wait 0.5
>> ~
~~ wait 0.5
>> ^H
~~ wait 0.5
>> ~
~~ wait 15
~~ answers 7
