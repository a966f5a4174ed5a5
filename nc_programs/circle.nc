(circle: radius 20 mm about X0 Y0, both senses, at 3000 and 1000 mm/min; arcs by I J and by R)
(made by twin_generate_programs, see README.md; starts at X0 Y0 Z0)
G21 G17 G90 G94
G64
G01 F3000
X20.0000 Y0.0000
(full circle, counter-clockwise, then clockwise)
G03 X20.0000 Y0.0000 I-20.0000 J0.0000
G02 X20.0000 Y0.0000 I-20.0000 J0.0000
(the same at a third of the feedrate)
G03 I-20.0000 J0.0000 F1000
G02 I-20.0000 J0.0000
(quarter arcs, counter-clockwise: R, R, I J, I J)
G03 X0.0000 Y20.0000 R20.0000 F3000
X-20.0000 Y0.0000 R20.0000
X0.0000 Y-20.0000 I20.0000 J0.0000
X20.0000 Y0.0000 I0.0000 J20.0000
(three quarters and a quarter, clockwise: R below zero is the longer arc)
G02 X0.0000 Y20.0000 R-20.0000
G02 X20.0000 Y0.0000 R20.0000
(half circles of 10 mm, one of each sense)
G03 X0.0000 Y0.0000 R10.0000
G02 X-20.0000 Y0.0000 I-10.0000 J0.0000
G01 X0.0000 Y0.0000
M30
