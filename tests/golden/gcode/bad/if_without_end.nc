o5 if [#1 EQ 1]
G0 X1
