"""Studies from Python."""

import subprocess
import sys

import pytest
import twin


def test_circle_has_the_deviations_of_circle_json(tmp_path):
    found = twin.circle(radius_mm=5, folder=tmp_path)
    assert (tmp_path / "circle.json").exists() and (tmp_path / "circle_cw.nc").exists()
    assert found["radius_mm"] == 5
    assert twin.circle(radius_mm=5) == found


def test_compare_runs_every_program_on_every_machine():
    soft = twin.Machine(servo__x__kp_per_s=60)
    rows = twin.compare(["square.nc", "circle.nc"], {"as is": twin.Machine(), "soft": soft})
    assert [(row["program"], row["machine"]) for row in rows] == [
        ("square.nc", "as is"),
        ("square.nc", "soft"),
        ("circle.nc", "as is"),
        ("circle.nc", "soft"),
    ]
    stiff, soft = (row["summary"]["tracking_error_um"]["x"]["rms"] for row in rows[:2])
    assert soft > stiff and all(row["failure"] is None for row in rows)


def test_converted_program_takes_the_same_way():
    text = twin.convert("oxalis.nc", "g6.2")
    converted = twin.check(twin.Program.from_text(text, "converted.nc"))
    original = twin.check("oxalis.nc")
    assert converted["length_mm"] == pytest.approx(original["length_mm"], rel=1e-3)
    with pytest.raises(twin.Error, match="unknown dialect g9"):
        twin.convert("oxalis.nc", "g9")


def test_the_package_is_the_command_too():
    said = subprocess.run(
        [sys.executable, "-m", "twin", "--version"], stdout=subprocess.PIPE, text=True, check=True
    ).stdout
    assert "twin" in said
