O31 (probing as FANUC and Mach write it)
G21 G90 F120
G0 Z10
G31 Z-4 F90
#1 = #5063
Z[#1 + 20]
G31.1 P1 X4
G1 Y[#5061 * 2]
M30
