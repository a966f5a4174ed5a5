"""Runs a program with a position loop of one's own in place of the machine's."""

import twin

machine = twin.Machine("xy_table.toml")
with twin.Plant(machine) as plant:
    scale = plant.mm_per_s_per_V
integral = [0.0, 0.0]


def servo(point: twin.SetPoint, measured: tuple[float, float]) -> list[float]:
    """Proportional and integral gain with velocity feedforward, in volts."""
    volts = []
    for k in (0, 1):
        error = point.position_mm[k] - measured[k]
        integral[k] += error * 0.001
        volts.append((100 * error + 500 * integral[k] + point.velocity_mm_per_s[k]) / scale[k])
    return volts


own = twin.run("square.nc", machine, servo=servo).summary["tracking_error_um"]
machines = twin.run("square.nc", machine).summary["tracking_error_um"]
for axis in "xy":
    print(f"{axis}: RMS {own[axis]['rms']:.2f} um, the machine's own {machines[axis]['rms']:.2f} um")
