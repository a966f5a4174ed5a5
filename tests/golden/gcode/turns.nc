(Several turns, centres in absolute coordinates, an end off the circle)
F600
G2 I5 P3
G3 X10 Y0 Z-3 I5 P2
G90.1 G2 X20 Y0 I15 J0
G91.1 G3 X30.025 I5
G18 G2 X32.025 Z-1 I2 K0
G19 G3 Y2 Z1 J2 K0 I0
M2
