"""Traces as HDF5: read by h5py and by Octave, the bytes of the command, what a killed run leaves."""

import json
import shutil
import signal
import subprocess
import time

import numpy as np
import pytest
import twin
from support import EXECUTABLE

SHORT = "G21 G90\nG1 X3 Y1 F1200\nX0 Y4\nG0 X0 Y0\nM30\n"


def command(*words):
    return subprocess.run([EXECUTABLE, *map(str, words)], capture_output=True, text=True)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """The folder of a run with both files of its trace."""
    folder = tmp_path_factory.mktemp("run")
    (folder / "short.nc").write_text(SHORT)
    run = command("run", folder / "short.nc", "--trace", "both", "--columns", "all", "--quiet",
                  "--no-plots", "--out", folder)
    assert run.returncode == 0, run.stderr
    return folder


def test_h5py_reads_what_the_csv_has(folder):
    h5py = pytest.importorskip("h5py")
    table = np.genfromtxt(folder / "trace.csv", delimiter=",", names=True)
    with h5py.File(folder / "trace.h5") as file:
        assert set(file) == set(table.dtype.names)
        for name in file:
            assert np.array_equal(file[name][:], table[name]), name
            assert file[name].attrs["long_name"]
        column = file["x_enc_mm"]
        assert column.attrs["units"] == b"mm" and file["x_torque_Nm"].attrs["units"] == b"N.m"
        assert file["line"].dtype == np.int64 and file["line"].attrs["units"] == b"1"
        assert (column.compression, column.compression_opts, column.shuffle) == ("gzip", 1, True)
        summary = json.loads((folder / "summary.json").read_text())
        assert file.attrs["program"] == b"short.nc"
        assert file.attrs["program_sha256"].decode() == summary["program_sha256"]
        assert file.attrs["version"].decode() == twin.__version__
        assert json.loads(file.attrs["summary"])["contour_error_um"] == summary["contour_error_um"]
        assert int(file.attrs["rows"]) == len(table)
        assert "[servo.x]" in file.attrs["settings"].decode()


def test_octave_reads_what_the_csv_has(folder):
    if not shutil.which("octave-cli"):
        pytest.skip("octave-cli is not installed")
    script = (
        f"t = load('{folder}/trace.h5'); c = dlmread('{folder}/trace.csv', ',', 1, 0);"
        f"f = fopen('{folder}/trace.csv'); names = strsplit(fgetl(f), ',');"
        "for i = 1:numel(names) assert(double(t.(names{i})(:)), c(:, i), 1e-12); end; disp(columns(c))"
    )
    octave = subprocess.run(["octave-cli", "--no-history", "--eval", script], capture_output=True,
                            text=True)
    assert octave.returncode == 0, octave.stderr
    assert octave.stdout.strip() == "28"


def test_saved_trace_has_the_bytes_of_the_command(folder, tmp_path):
    command("run", folder / "short.nc", "--trace", "hdf5", "--quiet", "--no-plots", "--out", tmp_path)
    result = twin.run(folder / "short.nc", folder=tmp_path / "while", trace="hdf5")
    result.save(tmp_path / "saved", trace="both")
    bytes_of_command = (tmp_path / "trace.h5").read_bytes()
    assert not (tmp_path / "trace.csv").exists()
    assert (tmp_path / "while" / "trace.h5").read_bytes() == bytes_of_command
    assert (tmp_path / "saved" / "trace.h5").read_bytes() == bytes_of_command
    with pytest.raises(twin.Error, match="expected csv, hdf5, both or none"):
        result.save(tmp_path, trace="mat")


def test_trace_is_read_back_from_either_file(folder):
    of_csv, of_hdf5 = twin.read_trace(folder / "trace.csv"), twin.read_trace(folder / "trace.h5")
    assert set(of_csv) == set(of_hdf5) and of_csv.period_s == of_hdf5.period_s == 0.001
    assert all(np.array_equal(of_csv[name], of_hdf5[name]) for name in of_csv)
    with pytest.raises(twin.Error, match="cannot open"):
        twin.read_trace(folder / "none.h5")


def test_commands_take_either_file(folder, tmp_path):
    (tmp_path / "trace.h5").write_bytes((folder / "trace.h5").read_bytes())
    (tmp_path / "summary.json").write_bytes((folder / "summary.json").read_bytes())
    assert command("report", tmp_path).returncode == 0
    (tmp_path / "trace.h5").write_bytes((folder / "trace.h5").read_bytes()[:5000])
    cut = command("report", tmp_path)
    assert cut.returncode != 0 and "trace.h5: cannot read this HDF5 file" in cut.stderr
    identify = command("identify", tmp_path / "trace.h5")
    assert identify.returncode != 0 and "may be cut short" in identify.stderr


def test_hdf5_of_others_is_a_recording(tmp_path):
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["time"] = np.arange(300)[:, np.newaxis]  # as MATLAB's h5create has it
        file["x"] = np.zeros(299)
        file["y"] = np.zeros(300)
        file.create_group("more")
    short = command("identify", tmp_path / "other.h5", "--columns", "t=time:ms,x_cmd=x,x_meas=y:um")
    assert "column x has 299 rows, but time has 300" in short.stderr
    missing = command("identify", tmp_path / "other.h5")
    assert "there are: time,x,y" in missing.stderr


def test_killed_run_leaves_what_was_flushed(tmp_path):
    h5py = pytest.importorskip("h5py")
    run = subprocess.Popen(
        [EXECUTABLE, "run", "dolphin.nc", "--hal", "ideal", "--feedrate-mm-per-min", "30", "--trace",
         "hdf5", "--quiet", "--no-plots", "--no-report", "--out", tmp_path]
    )
    file = tmp_path / "trace.partial.h5"
    until = time.monotonic() + 60
    while not (file.exists() and file.stat().st_size > 2_000_000) and time.monotonic() < until:
        time.sleep(0.01)
    run.send_signal(signal.SIGKILL)
    run.wait()
    with h5py.File(file) as left:
        rows = min(len(left[name]) for name in left)
        assert rows % 8192 == 0
        try:
            for name in left:
                left[name][:rows]
        except OSError:  # killed within a flush, whose rows are lost
            rows -= 8192
        assert rows >= 8192
        assert all(len(left[name][:rows]) == rows for name in left)
        assert np.allclose(np.diff(left["t_s"][:rows]), 0.001)
    assert len(twin.read_trace(file)["t_s"]) in (rows, rows + 8192)  # columns may have got further
    assert twin.read_trace(file).rows == rows


def test_table_of_a_sweep_is_read_by_h5py_and_octave(tmp_path):
    h5py = pytest.importorskip("h5py")
    (tmp_path / "short.nc").write_text(SHORT)
    (tmp_path / "s.toml").write_text(
        f'program = "{tmp_path}/short.nc"\nhal = "ideal"\ntrace = "hdf5"\n[grid]\n'
        '"limits.jerk_mm_per_s3" = [20000, 40000]\n"planning.planner" = ["paper", "certified"]\n'
    )
    swept = command("sweep", tmp_path / "s.toml", "--out", tmp_path / "out")
    assert swept.returncode == 0, swept.stderr
    with h5py.File(tmp_path / "out" / "results.h5") as file:
        assert list(file["limits.jerk_mm_per_s3"][:]) == [20000, 20000, 40000, 40000]
        assert file["limits.jerk_mm_per_s3"].attrs["units"] == b"mm/s^3"
        assert list(file["planning.planner"][:]) == [b"paper", b"certified"] * 2
        assert file["machining_time_s"][0] > file["machining_time_s"][2] > 0
        assert file["failure"][0] == b"" and len(file["key"][0]) == 64
    assert len(list((tmp_path / "out" / "store").glob("*/*/trace.h5"))) == 4
    if shutil.which("octave-cli"):
        octave = subprocess.run(
            ["octave-cli", "--no-history", "--eval",
             f"t = load('{tmp_path}/out/results.h5'); disp(numel(t.machining_time_s))"],
            capture_output=True, text=True)
        assert octave.stdout.strip() == "4", octave.stderr
