; The commands that calibrations are made of.
~~ include setup.inc
-> B01
<- B01
<- Motor Calibration Not Needed
<- ok
-> B06 L0 R0
<- B06 L0 R0
<- Setting Chain Lengths To: 
<- Left: 0.00mm
<- Right: 0.00mm
<* Message: Unable to find*
<- ok
-> G91
<- ok
-> B09 L12.7 R0
<- B09 L12.7 R0
<- ok
-> B09 L-2.7 R5
<- B09 L-2.7 R5
<- ok
-> G90
<- ok
-> B10 L
<- B10 L
<- [Measure: 10.00] within 0.02
<- ok
-> B10 R
<- B10 R
<- [Measure: 5.00] within 0.02
<- ok
-> B09 R0 L0
<- B09 R0 L0
<- ok
~~ wait 0.2
-> B10 L
<* [Measure: 0.00] within 0.02
<- ok
-> $11=100
<- ok
-> B02 L1 R0
<- B02 L1 R0
<- Measuring out left chain
<- 100.00mm within 0.05
<- ok
~~ off left
-> $11=1651
<- ok
-> B08
<- B08
<- Left: 1651.00mm
<- Right: 1651.00mm
<- [Forward Calculating Position]
<- position loaded at:
<* *
<* *
<- Message: The machine chains have been manually re-calibrated.
<- ok
-> $42=2000
<- ok
-> B11 S255 T1 L
<- B11 S255 T1 L
<- ok
~~ off left
-> B10 L
<- B10 L
; A short pull is a gentle pull: hardly any chain against a sled, 10 mm without.
<* [Measure: 1645.00] within 6.5
<- ok
-> B15
<- B15
<- [Forward Calculating Position]
<- position loaded at:
<- 0.00 within 0.02
<- 0.00 within 0.02
<- ok
