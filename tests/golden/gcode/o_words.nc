(subroutine with arguments, value and variables of its own)
o<square> sub
  #<half> = [#1 / 2]
  G1 X[#2 - #<half>] Y-#<half> F[#3 * 60]
  X[#2 + #<half>]
o<square> endsub [#1 ** 2]
#1 = 5
o<square> call [4] [10] [2]
G0 X#<_value> Y#1
o10 repeat [2]
  o20 if [#5420 GT 16.5]
    X20
  o20 elseif [#5420 GT 15]
    X17
  o20 else
    X0
  o20 endif
o10 endrepeat
#1 = 0
o30 do
  #1 = [#1 + 1]
  o40 if [#1 EQ 2]
    o30 continue
  o40 endif
  Y[ATAN[#1]/[#1] + #1]
o30 while [#1 LT 3]
(MSG, done)
M2
