(M70 to M73 keep the modal state, but not the motion word)
o10 sub
M73
G91
G1 X1 F1200
o10 endsub
G10 L2 P2 X50
G0 X1 F600
M70
G20 G91 G55 F1
G1 X1
M72
X5
o10 call
X2
M71
M2
