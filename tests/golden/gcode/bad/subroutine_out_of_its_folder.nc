o<../secret> call
G0 X1
