O0007 (G00 at the start and behind G80; A0 and G28 of an axis that is not there move nothing)
G71
X1 Y2 A0
G99 G81 X3 Z-1 R1 F60
G80
Z5
G91 G28 C0
G92 A0
M30
