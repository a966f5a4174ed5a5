"""Runs from Python: the same results as the command, memory shared, threads, orders while it runs."""

import gc
import json
import subprocess
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
import twin
from support import EXECUTABLE

SHORT = "G21 G90\nG1 X3 Y1 F1200\nX0 Y4\nG0 X0 Y0\nM30\n"


def short_program():
    return twin.Program.from_text(SHORT, "short.nc")


def test_saved_run_has_the_bytes_and_keys_of_the_command(tmp_path):
    subprocess.run(
        [EXECUTABLE, "run", "square.nc", "--quiet", "--no-plots", "--out", tmp_path / "command"],
        check=True,
    )
    result = twin.run("square.nc")
    result.save(tmp_path / "python")
    for name in ("trace.csv",):
        assert (tmp_path / "python" / name).read_bytes() == (tmp_path / "command" / name).read_bytes()
    command = json.loads((tmp_path / "command" / "summary.json").read_text())
    assert json.loads((tmp_path / "python" / "summary.json").read_text()) == result.summary
    assert result.summary.keys() == command.keys()
    assert result.summary["contour_error_um"] == command["contour_error_um"]


def test_folder_gets_the_files_while_the_program_runs(tmp_path):
    result = twin.run(short_program(), folder=tmp_path)
    result.save(tmp_path / "again")
    assert (tmp_path / "trace.csv").read_bytes() == (tmp_path / "again" / "trace.csv").read_bytes()


def test_columns_are_read_only_views_that_outlive_the_result():
    result = twin.run(short_program(), hal="ideal")
    x = result.trace["x_cmd_mm"]
    assert np.shares_memory(x, result.trace["x_cmd_mm"])
    assert not x.flags.owndata and x.dtype == np.float64
    with pytest.raises(ValueError):
        x[0] = 1.0
    copy, rows = x.copy(), result.trace.rows
    del result
    gc.collect()
    assert len(x) == rows and np.array_equal(x, copy)
    assert x[-1] == 0.0 and x.max() > 2.9


def test_trace_is_a_mapping_with_units():
    trace = twin.run(short_program(), hal="ideal").trace
    assert list(trace)[:3] == ["t_s", "segment", "line"]
    assert trace.units["feedrate_mm_per_s"] == "mm/s" and "segment" not in trace.units
    assert trace["t_s"][1] == trace.period_s == 0.001
    assert trace.to_dict()["t_s"].flags.owndata
    with pytest.raises(KeyError):
        trace["no_such_column"]


def test_ten_threads_at_once_get_what_one_gets():
    alone = twin.run(short_program()).trace["x_enc_mm"].copy()
    with ThreadPoolExecutor(10) as pool:
        results = list(pool.map(lambda _: twin.run(short_program()), range(10)))
    for result in results:
        assert np.array_equal(result.trace["x_enc_mm"], alone)


def test_override_slows_and_hold_and_stop_come_from_another_thread():
    plain = twin.run(short_program(), hal="ideal").summary["machining_time_s"]
    slow = twin.run(short_program(), hal="ideal", overrides=[(0, 50)])
    assert slow.summary["machining_time_s"] > 1.5 * plain
    panel = twin.Panel()

    def stop_it():
        while panel.display().state != "moving":
            time.sleep(0.01)
        panel.stop()

    stopper = threading.Thread(target=stop_it)
    stopper.start()
    result = twin.run("square.nc", hal="ideal", panel=panel, wall_clock=True)
    stopper.join()
    assert result.failure.code == "interrupted" and not result.trace.is_complete
    assert abs(result.trace["feedrate_mm_per_s"][-1]) < 1.0  # braked to rest on the path
    assert panel.display().state == "ended"


def test_fault_of_the_emulated_rig_is_the_failure_of_the_result():
    result = twin.run(short_program(), hal="emulated_rig", faults=["alarm:x@0.4"])
    assert result.failure.code == "machine" and "alarm" in result.failure.message
    assert 0 < result.trace.rows and not result.trace.is_complete


def test_without_trace_there_is_nothing_to_save(tmp_path):
    result = twin.run(short_program(), hal="ideal", keep_trace=False)
    assert result.trace is None
    with pytest.raises(twin.Error, match="kept no trace"):
        result.save(tmp_path)
