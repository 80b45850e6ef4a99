; GroundControl's first words: a soft reset, the settings, the version, the units, one setting.
<* ready
<- ok
<* Settings are the defaults. Chain lengths are not known yet*
>> ^X^N
<- 
<- soft reset commanded
<- PCB v1.2 Detected
<- Plumb v*
<* ready
<- ok
<- Laser off
-> $$ 
<- $0=2438.4 (*
<- $1=1219.2 (*
<- $2=2978.4 (*
<- $3=463 (*
<- $4=310 (*
<- $5=139 (*
<- $6=79 (*
<- $7=1 (*
<- $8=250 (*
<- $9=2000 (*
<- $10=3360 (*
<- $11=1651 (*
<- $12=8113.73 (*
<- $13=63.5 (*
<- $15=900 (*
<- $16=1 (*
<- $17=0 (*
<- $18=12.6 (*
<- $19=3.17 (*
<- $20=7560 (*
<- $21=1300 (*
<- $22=0 (*
<- $23=34 (*
<- $24=1 (*
<- $25=5 (*
<- $26=0 (*
<- $27=0.28 (*
<- $28=1 (*
<- $29=1300 (*
<- $30=0 (*
<- $31=34 (*
<- $32=1 (*
<- $33=5 (*
<- $34=0 (*
<- $35=0.28 (*
<- $36=1 (*
<- $37=0 (*
<- $38=1 (*
<- $39=3 (*
<- $40=0 (*
<- $41=0 (*
<- $42=2 (*
; Nothing that a client takes for its own: 43 to 46 and 85 to 98 are not there.
<- $60=4000 (*
<- $61=24000 (*
<- $62=97.9 (*
<* $227=0 (*
<- ok
-> B05  
<- B05
<- Firmware Version 1.28
<- ok
-> G21  
<- ok
-> $8=100 
<- ok
-> $43=0.0000
<- error: $43 *
-> $16=0.000000
<- ok
-> $16=1.000000
<- ok
; Nobody has set the chains yet: no setting makes the place a question.
~~ wait 1
~~ quiet
