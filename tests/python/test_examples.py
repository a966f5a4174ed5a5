"""The examples of docs/examples/python run and say what they should."""

import pathlib
import re
import subprocess
import sys

import pytest

FOLDER = pathlib.Path(__file__).parents[2] / "docs" / "examples" / "python"
EXPECTED = {
    "01_run": r"machining time 9\.5\d\d s\ncontour error max 1\d\.\d um.*\n9567 rows of 16 columns",
    "02_plan": r"'blocks': 4.*\n(jerk +\d+ mm/s\^3: [\d.]+ s, bound [\d.]+ s\n){3}",
    "03_sweep": r"(F\d+ Kp +[\d.]+: +[\d.]+ s, +[\d.]+ um\n){6}",
    "04_servo": r"x: RMS [\d.]+ um, .*\ny: RMS [\d.]+ um",
    "05_plant": r"largest tracking error of x: 2\d\.\d um",
    "06_identify": r"Coulomb friction of x: 1[34]\.\d N",
}


SLOW = {"06_identify"}
NAMES = [file.stem for file in sorted(FOLDER.glob("*.py"))]


@pytest.mark.parametrize("name", [pytest.param(name, marks=pytest.mark.slow if name in SLOW else ()) for name in NAMES])
def test_example(name):
    file = FOLDER / f"{name}.py"
    assert len(file.read_text().splitlines()) < 40
    said = subprocess.run(
        [sys.executable, file], stdout=subprocess.PIPE, text=True, timeout=120, check=True
    ).stdout
    assert re.search(EXPECTED[name], said), said
