(A further work offset, as FANUC has them)
G54.1 P3 G0 X1
G10 L2 P1 X5
G54 X0
G43 H0 G0 Z1
M2
