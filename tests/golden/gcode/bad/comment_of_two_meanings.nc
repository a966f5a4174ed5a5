G0 X1 (open (one) Y2
