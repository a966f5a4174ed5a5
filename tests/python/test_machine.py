"""The settings as a mapping."""

import copy
import pickle

import pytest
import twin


def test_keys_with_units_read_and_change():
    machine = twin.Machine("xy_table.toml")
    machine["limits.jerk_mm_per_s3"] = 20000
    machine["planning.planner"] = "paper"
    machine["limits.axis_jerk_mm_per_s3"] = [30000, 30000, 0]
    assert machine["limits.jerk_mm_per_s3"] == machine["limits.jerk"] == 20000
    assert machine["planning"]["planner"] == "paper"
    assert machine["limits"]["axis_jerk_mm_per_s3"] == [30000, 30000, 0]
    assert twin.Machine()["limits.jerk_mm_per_s3"] == 50000


def test_sections_show_and_make_changes():
    machine = twin.Machine()
    servo = machine["servo"]["x"]
    servo["kp_per_s"] = 100.0
    assert servo["kp_per_s"] == machine["servo.x.kp_per_s"] == 100.0
    assert set(servo) >= {"kp_per_s", "kd", "kf", "ka_s", "trim_V"}


def test_mapping_holds_every_key_of_the_machine_file():
    machine = twin.Machine()
    assert "limits.jerk_mm_per_s3" in machine and "limits.jrk" not in machine
    assert len(machine) == len(list(machine)) > 50
    assert all(machine[key] is not None for key in machine)


def test_wrong_settings_are_refused_and_change_nothing():
    machine = twin.Machine()
    with pytest.raises(KeyError, match="limits.jrk"):
        machine["limits.jrk"]
    for key, value in [("limits.jrk", 1), ("limits.jerk_mm_per_s3", -1), ("planning.planner", "x")]:
        with pytest.raises(twin.Error):
            machine[key] = value
    assert machine == twin.Machine()


def test_copies_are_independent(tmp_path):
    machine = twin.Machine(servo__x__kp_per_s=200)
    other = machine.replace({"servo.x.kp_per_s": 250})
    assert (machine["servo.x.kp_per_s"], other["servo.x.kp_per_s"]) == (200, 250)
    for same in (twin.Machine(machine), copy.deepcopy(machine), pickle.loads(pickle.dumps(machine))):
        assert same == machine and same["servo.x.kp_per_s"] == 200


def test_saved_machine_file_is_read_again(tmp_path):
    machine = twin.Machine(limits__jerk=20000)
    machine.save(tmp_path / "mine.toml")
    read = twin.Machine(tmp_path / "mine.toml")
    assert read["limits.jerk_mm_per_s3"] == 20000 and read.name == "mine"
