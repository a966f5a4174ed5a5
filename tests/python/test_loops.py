"""Loops written in Python: on the plant, from set points, and as the servo of a run."""

import numpy as np
import pytest
import twin

PROGRAM = twin.Program.from_text("G21 G90\nG1 X3 Y1 F1200\nX0 Y4\nG0 X0 Y0\nM30\n", "short.nc")
REST_PERIODS = 300  # before the first set point


class Loop:
    """The position loop of the machine file, Kp, Kf and Ka with the trim."""

    def __init__(self, machine, mm_per_s_per_V):
        self.gains = [machine["servo"][axis] for axis in "xy"]
        self.scale = mm_per_s_per_V

    def volts(self, position, velocity, acceleration, measured):
        result = []
        for k, gains in enumerate(self.gains):
            command = (
                gains["kp_per_s"] * (position[k] - measured[k])
                + gains["kf"] * velocity[k]
                + gains["ka_s"] * acceleration[k]
            )
            result.append(max(-10.0, min(10.0, command / self.scale[k] + gains["trim_V"])))
        return result


def test_closed_loop_on_the_plant_is_the_run_itself():
    machine = twin.Machine()
    run = twin.run(PROGRAM, machine)
    x, y, volts = [], [], []
    with twin.Plant(machine) as plant:
        loop = Loop(machine, plant.mm_per_s_per_V)
        zero = (0.0, 0.0, 0.0)
        for _ in range(REST_PERIODS):
            plant.advance()
            plant.command(loop.volts(zero, zero, zero, plant.position_mm), zero)
        for point in twin.SetPoints(PROGRAM, machine):
            plant.advance()
            measured = plant.position_mm
            volts.append(
                loop.volts(
                    point.position_mm, point.velocity_mm_per_s, point.acceleration_mm_per_s2, measured
                )
            )
            plant.command(volts[-1], point.position_mm)
            x.append(measured[0])
            y.append(measured[1])
    assert np.array_equal(x, run.trace["x_enc_mm"]) and np.array_equal(y, run.trace["y_enc_mm"])
    assert np.array_equal([v[0] for v in volts], run.trace["x_drive_V"])


def test_servo_of_python_runs_as_that_of_the_machine():
    machine = twin.Machine()
    with twin.Plant(machine) as plant:
        loop = Loop(machine, plant.mm_per_s_per_V)
    result = twin.run(
        PROGRAM,
        machine,
        servo=lambda point, measured: loop.volts(
            point.position_mm, point.velocity_mm_per_s, point.acceleration_mm_per_s2, measured
        ),
    )
    assert np.array_equal(result.trace["x_enc_mm"], twin.run(PROGRAM, machine).trace["x_enc_mm"])


def test_exception_of_the_servo_comes_out_of_the_run():
    calls = []

    def servo(point, measured):
        calls.append(point.time_s)
        if len(calls) == 310:
            raise ZeroDivisionError("in the loop")
        return [0.0, 0.0]

    with pytest.raises(ZeroDivisionError, match="in the loop"):
        twin.run(PROGRAM, servo=servo)
    assert len(calls) == 310  # the machine was switched off in that period


@pytest.mark.parametrize("answer", [None, [1.0], "volts", [float("nan"), 0.0]])
def test_servo_without_an_answer_switches_the_machine_off(answer):
    try:
        result = twin.run(PROGRAM, servo=lambda point, measured: answer)
    except TypeError as error:
        assert "two numbers" in str(error)
    else:
        assert "no drive command" in result.failure.message and result.failure.code == "machine"


def test_set_points_begin_and_end_at_rest():
    points = list(twin.SetPoints(PROGRAM))
    assert points[0].position_mm == (0.0, 0.0, 0.0) and points[0].time_s == 0.0
    assert points[-1].velocity_mm_per_s == pytest.approx((0.0, 0.0, 0.0), abs=1e-6)
    assert points[1].time_s == twin.SetPoints(PROGRAM).period_s


def test_plant_moves_by_its_drive_command_and_faults_show():
    with twin.Plant(hal="emulated_rig", faults=["alarm:y@0.2"]) as plant:
        for _ in range(400):
            plant.advance()
            plant.command((0.2, 0.0))
        assert plant.counts[0] != 0 and plant.truth_mm[0] != 0.0
        assert list(plant.alarm) == [False, True]
