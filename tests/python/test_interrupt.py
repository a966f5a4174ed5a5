"""Ctrl-C ends every call, and a machine that moves brakes first."""

import os
import signal
import subprocess
import sys
import time

import pytest

import twin

HEAD = "import sys, twin\nprint('begin', flush=True)\ntry:\n"
TAIL = "except KeyboardInterrupt:\n    print('interrupted')\n    sys.exit(42)\n"
LONG = "twin.Program.from_text('G21 G90\\n' + 'G1 X10 F6\\nX0\\n' * 4000)"
CALLS = {
    "run": f"    twin.run({LONG}, folder=sys.argv[1])\n",
    "wall_clock": f"    twin.run({LONG}, folder=sys.argv[1], hal='ideal', wall_clock=True)\n",
    "plan": "    while True: twin.plan('trochoid.nc')\n",
    "learn_shadow": "    while True: twin.learn_shadow([sys.argv[2]] * 40, file=sys.argv[1] + '/learnt.json')\n",
    "watch": "    while True: twin.watch([sys.argv[2]] * 40)\n",
}
RECORDED = ("learn_shadow", "watch")


@pytest.fixture(scope="session")
def trace(tmp_path_factory):
    folder = tmp_path_factory.mktemp("recorded")
    twin.run("dolphin.nc", folder=folder)
    return folder / "trace.csv"


@pytest.mark.parametrize("call", CALLS)
def test_ctrl_c_ends_the_call(call, tmp_path, trace):
    child = subprocess.Popen(
        [sys.executable, "-c", HEAD + CALLS[call] + TAIL, tmp_path, trace],
        stdout=subprocess.PIPE,
        env=os.environ,
        text=True,
    )
    assert child.stdout.readline() == "begin\n"
    time.sleep(0.5)
    child.send_signal(signal.SIGINT)
    out, _ = child.communicate(timeout=20)
    assert (child.returncode, out) == (42, "interrupted\n")
    assert not (tmp_path / "trace.csv").exists()
    if call == "wall_clock":
        last = (tmp_path / "trace.partial.csv").read_text().splitlines()[-1].split(",")
        assert abs(float(last[6])) < 1.0  # at rest, or in its last period before it
