(nothing says how I and J are meant: the first arc fits absolute centres alone)
G0 X10 Y0
G3 X0 Y10 I0 J0 F60
G2 X5 Y5 I5 J10
