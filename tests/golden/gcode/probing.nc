(a part is looked for, and its corner becomes the origin)
G21 G90 F120
G0 X5 Y5 Z10
G38.2 Z-4
#100 = #5063
G10 L20 P1 Z0
G91
G38.3 X-3
X-2
G90
G38.5 X8 F600
o10 if [#5070 EQ 0]
  G0 Z[#100 + 20]
o10 endif
M2
