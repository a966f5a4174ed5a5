G0 X-inf
