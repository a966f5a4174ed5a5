"""A position loop of one's own on the simulated table, period by period."""

import twin

machine = twin.Machine("xy_table.toml")
servo = [machine["servo"][axis] for axis in "xy"]


def volts(
    point: twin.SetPoint, measured: tuple[float, float], scale: list[float]
) -> list[float]:
    """V-REF of x and y [V]: proportional gain, feedforward of velocity and acceleration."""
    command = [
        gains["kp_per_s"] * (point.position_mm[k] - measured[k])
        + gains["kf"] * point.velocity_mm_per_s[k]
        + gains["ka_s"] * point.acceleration_mm_per_s2[k]
        for k, gains in enumerate(servo)
    ]
    return [command[k] / scale[k] + servo[k]["trim_V"] for k in (0, 1)]


worst = 0.0
with twin.Plant(machine) as plant:
    for _ in range(300):  # the drives switch on, and the loops come to rest
        plant.advance()
        rest = [-servo[k]["kp_per_s"] * plant.position_mm[k] / plant.mm_per_s_per_V[k] for k in (0, 1)]
        plant.command(rest)
    for point in twin.SetPoints("square.nc", machine):
        plant.advance()
        plant.command(volts(point, plant.position_mm, plant.mm_per_s_per_V), point.position_mm)
        worst = max(worst, abs(point.position_mm[0] - plant.position_mm[0]))
print(f"largest tracking error of x: {1000 * worst:.1f} um")
