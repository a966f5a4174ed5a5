"""Sweeps a gain over two feedrates: contour error against machining time."""

from concurrent.futures import ThreadPoolExecutor

import twin

machine = twin.Machine("xy_table.toml")
cases = [(feed, kp) for feed in (1500, 3000) for kp in (60.0, 110.0, 160.0)]


def contour_error(case: tuple[int, float]) -> tuple[float, float]:
    feed, kp = case
    result = twin.run("square.nc", machine.replace({"servo.y.kp_per_s": kp}),
                      feedrate_mm_per_min=feed, keep_trace=False)
    return result.summary["machining_time_s"], result.summary["contour_error_um"]["max"]


with ThreadPoolExecutor(2) as pool:
    for (feed, kp), (time, error) in zip(cases, pool.map(contour_error, cases)):
        print(f"F{feed} Kp {kp:5.1f}: {time:7.3f} s, {error:6.2f} um")
