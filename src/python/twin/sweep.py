"""Sweeps on many machines, by Dask.distributed.

    dask-scheduler --host 10.0.0.1                              # on one
    dask-worker tcp://10.0.0.1:8786 --nworkers 2 --nthreads 1   # on each, with twin importable
    python3 -m twin.sweep gains.toml --scheduler tcp://10.0.0.1:8786 --store /shared/store

The store is a folder that all of them see. What it holds is not computed again, equal jobs run
once, and the jobs of a worker that dies are given to others.
"""

import argparse
import functools
import hashlib
import os
import sys

from . import _twin
from ._error import Error

RETRIES = 3  # of a job whose worker dies


@functools.lru_cache(maxsize=None)
def build():
    """What tells builds of twin apart: the version and the checksum of its library."""
    with open(_twin.library_file(), "rb") as library:
        digest = hashlib.sha256(library.read()).hexdigest()
    return f"{_twin.version}-{digest[:16]}"


def run_job(job, store, wanted_build):
    """Runs a job on a worker, unless the store holds it. Returns its key and why it failed, or ""."""
    if build() != wanted_build:
        raise Error(f"this worker has twin {build()}, but the sweep was made with {wanted_build}")
    result = _twin.run_job(job, store)
    return result.key, result.failure


def run_sweep(sweep_file, scheduler, store, folder, progress=lambda done, jobs: None):
    """Runs a sweep on the workers of a scheduler and writes its table and page.

    Args:
        sweep_file: TOML, see docs/sweeps.md
        scheduler: address, such as "tcp://10.0.0.1:8786"
        store: folder of the results, which every worker sees under this path
        folder: gets results.csv, index.html, best.toml and jobs.jsonl
        progress: called with the number of jobs done and of all

    Returns:
        number of jobs, and of those whose run failed

    Raises:
        Error: the sweep is wrong, a worker has another build, or a job lost its worker too often
    """
    import distributed

    jobs = _twin.sweep_jobs(os.fspath(sweep_file))
    keys = [_twin.job_key(job) for job in jobs]
    unique = dict(zip(keys, jobs))
    store = os.path.abspath(store)
    failed = 0
    with distributed.Client(scheduler, timeout="20s", set_as_default=False) as client:
        futures = [
            client.submit(run_job, job, store, build(), key=f"twin-{key}", retries=RETRIES)
            for key, job in unique.items()
        ]
        for done, (future, result) in enumerate(
            distributed.as_completed(
                futures, loop=client.loop, with_results=True, raise_errors=False
            ),
            start=1,
        ):
            if future.status != "finished":
                client.cancel(futures)
                raise Error(f"a job did not end: {future.exception()}")
            failed += result[1] != ""
            progress(done, len(unique))
    _twin.write_sweep(os.fspath(sweep_file), store, os.fspath(folder))
    return len(unique), failed


def _show(done, jobs):
    if sys.stderr.isatty():
        print(f"\rtwin: {done} of {jobs} runs", end="", file=sys.stderr, flush=True)


def main():
    """The command ``python3 -m twin.sweep``."""
    parser = argparse.ArgumentParser(prog="python3 -m twin.sweep", description=__doc__.split("\n")[0])
    parser.add_argument("sweep", help="TOML file, see docs/sweeps.md")
    parser.add_argument("--scheduler", required=True, help="address, as in tcp://10.0.0.1:8786")
    parser.add_argument("--store", required=True, help="folder of the results that all hosts see")
    parser.add_argument("--out", help="folder of table and page [renders/SWEEP]")
    arguments = parser.parse_args()
    stem = os.path.splitext(os.path.basename(arguments.sweep))[0]
    folder = arguments.out or os.path.join("renders", stem)
    try:
        jobs, failed = run_sweep(
            arguments.sweep, arguments.scheduler, arguments.store, folder, _show
        )
    except ImportError:
        sys.exit("twin: Dask.distributed is missing; on Debian install python3-distributed")
    except (Error, OSError) as error:
        sys.exit(f"twin: {error}")
    print(f"{jobs} jobs, {failed} failed\ntable, page and best settings: {folder}/index.html")


if __name__ == "__main__":
    main()
