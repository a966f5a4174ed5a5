%
(arcs by centre and by radius, both ways, in three planes)
N10 G17 G21 G90 F1200
N20 G00 X10 Y0
N30 G03 X0 Y10 I-10 J0
N40 G02 X-10 Y20 R10
N50 G02 X-20 Y10 R-10
N60 G03 I5 (a full circle)
N70 G02 X-18 Y12 Z3 I2 J0 (helix)
N80 G18 G03 X-22 Z-1 I-4 K0
N90 G19 G02 Y14 Z1 R2
N100 G17 G91 G03 X4 Y0 I2
%
not read
