(LinuxCNC's polar words: @ distance from the origin, ^ angle)
G0 X10 Y0 Z5
G0 @5 ^90
G1 ^180 F600
@7
G3 @7 ^270 I7 J0
G91 G1 @3 ^90 Z-1
G90 G0 @10 ^0
G91 G81 ^120 R-1 Z-2 L2
G80
G90 G20 G0 @1 ^0
M2
