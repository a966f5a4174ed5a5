(comments stand before an O-word, and between the arguments of a call)
o1 sub
G0 X#1 Y#2
o1 endsub
(a) o1 call [3] (b) [4]
N10 (c) o2 if [EXISTS[#3] AND EXISTS[#<nobody>]]
X9
(d) o2 endif
o1 callsub [5] [6] ; e
M2
