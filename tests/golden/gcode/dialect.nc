; line ends of another system, a byte order mark, no last line end
G0 X1

/G0 X50
G1 F60 (in between) Y2 ; and after
G4 P0.5
T2 M6
G61 X3
G61.1 Y4
G64 X5
M0 Y6
M3 S8000 M8
X7