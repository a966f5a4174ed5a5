"""Runs a program on the simulated table and says how exact it was."""

import twin

result = twin.run("dolphin.nc", machine=twin.Machine("xy_table.toml"))
error = result.summary["contour_error_um"]
print(f"machining time {result.summary['machining_time_s']:.3f} s")
print(f"contour error max {error['max']:.1f} um, RMS {error['rms']:.2f} um")
print(f"{result.trace.rows} rows of {len(result.trace)} columns: {', '.join(result.trace)}")
