"""Plans a program of one's own and compares its time with the lower bound."""

import twin

TEXT = """G21 G90 G64 P0.02
G1 X40 Y0 F6000
X40 Y30
G2 X10 Y30 I-15 J0
G1 X0 Y0
M30
"""
program = twin.Program.from_text(TEXT, "gate.nc")
print(twin.check(program))
for jerk in (20_000, 50_000, 200_000):
    plan = twin.plan(program, twin.Machine(limits__jerk_mm_per_s3=jerk))
    print(f"jerk {jerk:6} mm/s^3: {plan.time_s:.3f} s, bound {plan.bound_s():.3f} s")
