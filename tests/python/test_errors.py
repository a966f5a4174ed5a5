"""What is wrong is said with its place, and nothing else happens."""

import pickle

import pytest
import twin


def test_program_error_has_line_and_column():
    program = twin.Program.from_text("G21\nG1 X1 Q F100\n", "bad.nc")
    with pytest.raises(twin.Error) as caught:
        twin.check(program)
    assert (caught.value.file, caught.value.line) == ("bad.nc", 2) and caught.value.column > 0
    assert caught.value.code == "program" and str(caught.value).startswith("bad.nc:2:")


@pytest.mark.parametrize(
    "call",
    [
        lambda: twin.run("no_such_program.nc"),
        lambda: twin.plan("no_such_program.nc"),
        lambda: twin.Machine("no_such_machine.toml"),
        lambda: twin.identify(["no_such_trace.csv"]),
        lambda: twin.SetPoints("no_such_program.nc"),
    ],
)
def test_missing_file_is_named(call):
    with pytest.raises(twin.Error, match="no_such_"):
        call()


def test_unknown_names_are_refused():
    with pytest.raises(twin.Error, match="expected mujoco, ideal or emulated_rig"):
        twin.run("square.nc", hal="mojoco")
    with pytest.raises(twin.Error, match="fault"):
        twin.run("square.nc", hal="emulated_rig", faults=["earthquake@1"])
    with pytest.raises(TypeError):
        twin.run("square.nc", unknown=1)


def test_feedrate_of_zero_is_refused():
    with pytest.raises(twin.Error, match="must be above 0"):
        twin.check("square.nc", feedrate_mm_per_min=0)


def test_error_survives_pickling():
    error = pickle.loads(pickle.dumps(twin.Error("too fast", "a.nc", 3, 4, "program")))
    assert (str(error), error.line, error.code) == ("a.nc:3:4: too fast", 3, "program")
