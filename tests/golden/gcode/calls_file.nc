G0 X1
o<golden_slot> call [5]
X2
