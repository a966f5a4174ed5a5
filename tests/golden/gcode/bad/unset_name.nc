G0 X1
X[#<depth> * 2]
