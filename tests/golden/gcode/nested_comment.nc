G0 X1 (a (b) c)
