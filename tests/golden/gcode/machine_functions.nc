(functions of the machine's builder move nothing; F0 is no feedrate)
M41
G0 X1 F0 M88
M31
G1 X2 F60 M12
M445 P2
M2
