"""Sweeps on one machine and on many."""

import filecmp
import json
import os
import shutil
import signal
import subprocess
import sys

import pytest
import twin
from support import EXECUTABLE
from twin import _twin, sweep

SWEEP = """
program = "short.nc"
hal = "{hal}"
[grid]
"servo.x.kp_per_s" = {{ from = 100, to = 300, count = {count} }}
"""
SHORT = "G21 G90\nG1 X3 Y1 F1200\nX0 Y4\nM30\n"
PORT = 8786


def make_sweep(folder, count, hal="mujoco"):
    (folder / "short.nc").write_text(SHORT)
    file = folder / "gains.toml"
    file.write_text(SWEEP.format(count=count, hal=hal))
    return file


def same_files(one, two):
    """Whether two folders hold the same names with the same bytes."""
    compared = filecmp.dircmp(one, two)
    _, differ, odd = filecmp.cmpfiles(one, two, compared.common_files, shallow=False)
    return not (compared.left_only or compared.right_only or differ or odd) and all(
        same_files(one / name, two / name) for name in compared.common_dirs
    )


def run_on_one(file, store, folder):
    subprocess.run(
        [EXECUTABLE, "sweep", file, "--store", store, "--out", folder, "--quiet"],
        cwd=file.parent,
        check=True,
    )


def test_jobs_of_python_are_those_of_the_command(tmp_path, monkeypatch):
    file = make_sweep(tmp_path, 4)
    monkeypatch.chdir(tmp_path)
    run_on_one(file, tmp_path / "command", tmp_path / "out")
    jobs = _twin.sweep_jobs(str(file))
    assert len(jobs) == 4 and json.loads(jobs[0])["set"] == {"servo.x.kp_per_s": 100}
    found = [_twin.run_job(job, str(tmp_path / "command")) for job in jobs]
    assert all(result.was_found for result in found)
    again = [_twin.run_job(job, str(tmp_path / "python")) for job in jobs]
    assert not any(result.was_found for result in again)
    assert same_files(tmp_path / "command", tmp_path / "python")
    _twin.write_sweep(str(file), str(tmp_path / "python"), str(tmp_path / "again"))
    assert same_files(tmp_path / "out", tmp_path / "again")


def test_result_that_is_missing_is_said(tmp_path, monkeypatch):
    file = make_sweep(tmp_path, 2)
    monkeypatch.chdir(tmp_path)
    with pytest.raises(twin.Error, match="no result of job 1"):
        _twin.write_sweep(str(file), str(tmp_path / "store"), str(tmp_path / "out"))
    with pytest.raises(twin.Error, match="expected one job"):
        _twin.run_job("no JSON", str(tmp_path / "store"))


def test_worker_of_another_build_is_refused(tmp_path):
    with pytest.raises(twin.Error, match="this worker has twin"):
        sweep.run_job("{}", str(tmp_path), "0.0.0-another")


def in_host(name, *command, **options):
    """Starts a command in a network namespace, in a process group of its own."""
    return subprocess.Popen(
        ["ip", "netns", "exec", name, *command], start_new_session=True, **options
    )


@pytest.fixture
def hosts():
    """Two hosts, each with a network of its own, and a bridge that joins them with this one."""
    pytest.importorskip("distributed", reason="python3-distributed is not installed")
    if shutil.which("ip") is None or os.geteuid() != 0:
        pytest.skip("network namespaces need root and ip (iproute2)")
    suffix = str(os.getpid())
    bridge, names = f"tw{suffix}"[:15], [f"twin{suffix}{n}" for n in "ab"]

    def ip(*words, check=True):
        return subprocess.run(["ip", *words], stderr=subprocess.PIPE, text=True, check=check)

    made = ip("netns", "add", names[0], check=False)
    if made.returncode != 0:
        pytest.skip(f"no network namespace can be made: {made.stderr.strip()}")
    try:
        ip("link", "add", bridge, "type", "bridge")
        ip("addr", "add", "10.213.77.1/24", "dev", bridge)
        ip("link", "set", bridge, "up")
        for number, name in enumerate(names, start=1):
            if number > 1:
                ip("netns", "add", name)
            link = f"tv{suffix}{number}"[:15]
            ip("link", "add", link, "type", "veth", "peer", "name", "eth0", "netns", name)
            ip("link", "set", link, "master", bridge, "up")
            ip("-n", name, "addr", "add", f"10.213.77.{number + 1}/24", "dev", "eth0")
            ip("-n", name, "link", "set", "eth0", "up")
            ip("-n", name, "link", "set", "lo", "up")
        yield names
    finally:
        ip("link", "del", bridge, check=False)
        for name in names:
            ip("netns", "del", name, check=False)


@pytest.mark.slow
def test_sweep_on_two_hosts_survives_the_death_of_one(hosts, tmp_path):
    count = 40
    file = make_sweep(tmp_path, count)
    run_on_one(file, tmp_path / "one", tmp_path / "one_out")
    address = f"10.213.77.1:{PORT}"
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "cwd": tmp_path}
    python = [sys.executable, "-m"]
    scheduler = subprocess.Popen(
        [*python, "distributed.cli.dask_scheduler", "--host", "10.213.77.1", "--port", str(PORT),
         "--no-dashboard"],
        start_new_session=True,
        **quiet,
    )
    workers = [
        in_host(host, *python, "distributed.cli.dask_worker", f"tcp://{address}", "--nthreads",
                "1", "--no-dashboard", "--no-nanny", **quiet)
        for host in hosts
    ]
    killed_at = []

    def kill_one(done, jobs):
        if done == 10:
            os.killpg(workers[0].pid, signal.SIGKILL)
            killed_at.append(done)

    try:
        before = os.getcwd()
        os.chdir(tmp_path)
        try:
            jobs, failed = sweep.run_sweep(
                file, f"tcp://{address}", tmp_path / "two", tmp_path / "two_out", kill_one
            )
        finally:
            os.chdir(before)
    finally:
        for process in (scheduler, *workers):
            try:
                os.killpg(process.pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
            process.wait()
    assert (jobs, failed, killed_at) == (count, 0, [10])
    assert same_files(tmp_path / "one_out", tmp_path / "two_out")
    for key in (tmp_path / "one").glob("??/*"):
        other = tmp_path / "two" / key.parent.name / key.name
        assert same_files(key, other)
