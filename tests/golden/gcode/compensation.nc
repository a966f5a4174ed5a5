(Beside a contour: lead in, outer and inner corners, arcs, a move across, lead out)
G21 G17 G90 F600
G0 X-10 Y0
G41.1 D4 G1 X0
Y20
X20
G2 X30 Y10 J-10
G1 Z-1
Y0
G3 X20 Y-10 I-10
G1 X-20 Y-10
G40 G0 X-20 Y0
G10 L1 P5 R1.5
T5 M6
G42 D5 G1 X0 Y0
X10
Y10
G4 P0.5
X0
G40 G1 X-5 Y20
M2
