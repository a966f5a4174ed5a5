"""Digital twin of a servo XY table and of the CNC controller that drives it.

    import twin

    result = twin.run("dolphin.nc", machine=twin.Machine("xy_table.toml"))
    result.summary["contour_error_um"]["max"]
    result.trace["x_enc_mm"]

Lengths are in mm and times in s, unless a name ends with another unit. Every function raises
twin.Error if a program, a file or a setting is wrong; it knows file, line and column. All of them
may be called from several threads at once, and Ctrl-C ends each: a machine that moves brakes first.
"""

import json
import os
import tempfile
from concurrent.futures import ThreadPoolExecutor

from . import _twin
from ._arguments import SECONDS_PER_MINUTE as _SECONDS_PER_MINUTE
from ._arguments import paths as _paths
from ._arguments import program_of as _program
from ._arguments import settings_of as _settings
from ._beside import compensate, learn_shadow, watch
from ._error import Error
from ._machine import Machine, Section
from ._results import Identification, Result, Trace
from ._twin import Panel, Plan, Program, SetPoint, ShadowFinding, ShadowReport

__version__ = _twin.version

__all__ = [
    "Error",
    "Identification",
    "Machine",
    "Panel",
    "Plan",
    "Plant",
    "Program",
    "Result",
    "Section",
    "SetPoint",
    "SetPoints",
    "ShadowFinding",
    "ShadowReport",
    "Trace",
    "Tuning",
    "check",
    "circle",
    "compare",
    "compensate",
    "convert",
    "identify",
    "learn_shadow",
    "plan",
    "read_trace",
    "report",
    "run",
    "tune",
    "watch",
]

def check(program, machine="xy_table.toml", *, feedrate_mm_per_min=None):
    """Reads a whole program and checks that it stays within the travel of the machine.

    Args:
        program: path of a file, name of a program that twin brings, or a Program
        machine: a Machine, or the name of a machine file
        feedrate_mm_per_min: replaces the program's F words

    Returns:
        dict with blocks, length_mm, box_min_mm and box_max_mm (x, y, z)
    """
    return _twin.check(_program(program, feedrate_mm_per_min), _settings(machine))


def plan(program, machine="xy_table.toml", *, feedrate_mm_per_min=None):
    """Plans a whole program; nothing moves. Returns a Plan: time_s, path_length_mm, segments, ...

    Plan.bound_s() is a lower bound of the time on the same path. The arguments are those of check().
    """
    return _twin.plan(_program(program, feedrate_mm_per_min), _settings(machine))


def run(
    program,
    machine="xy_table.toml",
    *,
    hal="mujoco",
    feedrate_mm_per_min=None,
    overrides=(),
    faults=(),
    servo=None,
    panel=None,
    keep_trace=True,
    wall_clock=False,
    folder=None,
    trace="csv",
    correction=None,
    learn=None,
    shadow=None,
):
    """Plans a program, moves the machine along it and records every period.

    In simulated time the same call gives the same trace each time, byte for byte that of the
    command `twin run`.

    Args:
        program, machine, feedrate_mm_per_min: as check() has them
        hal: "mujoco" (the simulated table), "ideal" or "emulated_rig"
        overrides: pairs of a time [s] and a feed override [%]; 0 is a feed hold
        faults: what breaks on the emulated rig, such as "alarm:x@1.5"
        servo: position loops in place of those of the machine, a function of a SetPoint and of the
            measured x and y [mm] that returns V-REF of x and y [V]; called once a period
        panel: a Panel, by which other threads override, hold and stop the motion
        keep_trace: whether the result gets the trace in memory
        wall_clock: whether a period takes a period of the wall clock
        folder: where trace and summary.json are written while it runs; None: no files
        trace: files of the trace in that folder: "csv", "hdf5", "both" or "none"
        correction: file of compensate() that the run follows
        learn: folder in which runs are learnt from: the run follows the correction in it and leaves a
            better one for the next run
        shadow: file of learn_shadow(), or "" for what the model alone knows: the identified table runs
            beside the machine, and the result's shadow is its ShadowReport; None: no shadow

    Returns:
        Result; its failure says why a run ended early

    Raises:
        Error: the run could not begin; nothing has moved
        KeyboardInterrupt: after the machine has braked to rest on the path
    """
    text, settings = _program(program, feedrate_mm_per_min), _settings(machine)
    outcome = _twin.run(
        text,
        settings,
        hal=hal,
        faults=list(faults),
        overrides=[(float(time), float(percent)) for time, percent in overrides],
        folder="" if folder is None else os.fspath(folder),
        keep_trace=keep_trace,
        wall_clock=wall_clock,
        panel=panel,
        servo=servo,
        trace_files=trace,
        correction="" if correction is None else os.fspath(correction),
        learning="" if learn is None else os.fspath(learn),
        shadow=None if shadow is None else os.fspath(shadow),
    )
    return Result(outcome, text, settings)


def read_trace(file):
    """Reads a trace from a file, CSV or HDF5 by its content. Returns a Trace.

    The file may be any table of numbers with named columns. Units are known of traces of run() alone.
    """
    return Trace(_twin.read_trace(os.fspath(file)))


def identify(
    traces,
    machine="xy_table.toml",
    *,
    columns="",
    fixed=(),
    freed=(),
    at_table=(),
    validate=(),
    evaluations=0,
    seed=1,
):
    """Fits a machine's parameters to traces recorded on it.

    Args:
        traces: a CSV or HDF5 file, or several; each with even time, set points and measured positions
        machine: settings that the search begins at, and that what is not identified keeps
        columns: which columns are which signal, "SIGNAL=COLUMN[:UNIT],..."; "": as trace.csv
        fixed: keys that keep their value
        freed: keys that are fitted though they would be held
        at_table: further traces, recorded with the encoder at the table: they tell stiffness and play of the screw
        validate: a recording that is predicted and not fitted, or several; (): the last 30 % of each trace
        evaluations: simulations of the global search; 0: as many as usual
        seed: of the global search; the same seed gives the same result

    Returns:
        Identification
    """
    found = _twin.identify(
        _paths(traces),
        _settings(machine),
        columns=columns,
        fixed=list(fixed),
        freed=list(freed),
        at_table=_paths(at_table),
        validating=_paths(validate),
        evaluations=evaluations,
        seed=seed,
    )
    return Identification(found, Machine(found.settings))


def compare(programs, machines, *, hal="mujoco", feedrate_mm_per_min=None, workers=None):
    """Runs every program on every machine, as many at once as there are cores.

    Args:
        programs: a program or several, as run() has them
        machines: a dict of names and Machines; what differs in them is compared
        hal, feedrate_mm_per_min: as run() has them
        workers: runs at a time; None: as many as there are cores

    Returns:
        a list of dicts, one a run, programs before machines, each with the names "program" and
        "machine", the "summary" and the "failure" (an Error or None)
    """
    many = [programs] if isinstance(programs, (str, os.PathLike, Program)) else list(programs)
    cases = [(program, name) for program in many for name in machines]

    def row(case):
        program, name = case
        result = run(program, machines[name], hal=hal, feedrate_mm_per_min=feedrate_mm_per_min,
                     keep_trace=False)
        return {"program": result.summary["program"], "machine": name, "summary": result.summary,
                "failure": result.failure}

    with ThreadPoolExecutor(workers or os.cpu_count()) as pool:
        return list(pool.map(row, cases))


def circle(machine="xy_table.toml", *, radius_mm=20.0, feedrate_mm_per_min=3000.0, folder=None):
    """Runs a circle in both senses on the simulated table: the circular test of ISO 230-4.

    Args:
        machine: a Machine, or the name of a machine file
        radius_mm, feedrate_mm_per_min: of the circle about X0 Y0
        folder: gets programs, traces and circle.json; None: no files are left

    Returns:
        dict as in circle.json
    """
    with tempfile.TemporaryDirectory() as unused:
        _, found = _twin.circle(_settings(machine), radius_mm,
                                feedrate_mm_per_min / _SECONDS_PER_MINUTE,
                                unused if folder is None else os.fspath(folder))
    return json.loads(found)


def report(folders, file=None, *, programs=()):
    """Writes the page of a run, or of several side by side, as `twin report` does.

    Args:
        folders: folder of a run with its trace and summary, or several
        file: the page; None: report.html in the folder, or of several in renders
        programs: the programs that were run, as check() has them, for their text and path; those that
            twin brings are found without

    Returns:
        the name of the page
    """
    many = [folders] if isinstance(folders, (str, os.PathLike)) else list(folders)
    if file is None:
        file = os.path.join(many[0] if len(many) == 1 else "renders", "report.html")
    given = [programs] if isinstance(programs, (str, os.PathLike, Program)) else programs
    _twin.write_report([os.fspath(folder) for folder in many], os.fspath(file),
                       [_program(program, None) for program in given])
    return os.fspath(file)


class Tuning:
    """What a search for settings has found.

    Attributes:
        machine: the Machine with the settings that were found
        settings: a dict of the tuned keys and their values
        report: all of tune.json as a dict: figures and margins before and after, on every program
        table: what `twin tune` prints
    """

    def __init__(self, table, text, machine_file):
        self.table = table
        self.report = json.loads(text)
        self.settings = self.report["settings"]
        self.machine = Machine(machine_file)

    def __repr__(self):
        return f"Tuning({self.settings})"


def tune(
    programs,
    machine="xy_table.toml",
    *,
    folder,
    within_um=None,
    vary=None,
    gain_margin_dB=6.0,
    phase_margin_deg=30.0,
    also=(),
    trials=2000,
    seed=1,
    workers=None,
    store=None,
    feedrate_mm_per_min=None,
):
    """Searches for the servo gains and planner settings that are best for some programs, by CMA-ES
    over whole runs on the simulated table.

    Called again after it was interrupted or killed, it goes on from what the store holds.

    Args:
        programs: a file, the name of a program that twin brings, or several
        machine: a Machine, or the name of a machine file, with the settings that the search begins at
        folder: gets best.toml, tune.json, results.csv, index.html, and the store
        within_um: None: least contour error; a number: least machining time within this contour error
        vary: a dict of keys and ranges, as in {"servo.x.kp_per_s": (100, 500)}; None: the usual ones
        gain_margin_dB, phase_margin_deg: least margins of both position loops
        also: programs that are judged at the end and not tuned on
        trials: combinations of settings at most
        seed: of the search; the same seed gives the same result, on any number of cores
        workers: trials at a time; None: as many as there are cores
        store: folder of the runs; None: a folder in `folder`
        feedrate_mm_per_min: replaces the programs' F words

    Returns:
        Tuning
    """
    many = [programs] if isinstance(programs, (str, os.PathLike)) else list(programs)
    if isinstance(machine, Machine):
        os.makedirs(folder, exist_ok=True)
        file = os.path.join(folder, "start.toml")
        machine.save(file)
        machine = file
    found = _twin.tune(
        [os.fspath(program) for program in many],
        os.fspath(machine),
        feedrate_mm_per_s=None
        if feedrate_mm_per_min is None
        else feedrate_mm_per_min / _SECONDS_PER_MINUTE,
        within_um=within_um,
        gain_margin_dB=gain_margin_dB,
        phase_margin_deg=phase_margin_deg,
        ranges=[f"{key}={low}:{high}" for key, (low, high) in (vary or {}).items()],
        further=[os.fspath(program) for program in also],
        trials=trials,
        seed=seed,
        workers=workers or 0,
        store="" if store is None else os.fspath(store),
        folder=os.fspath(folder),
    )
    return Tuning(*found)


def convert(program, to, machine="xy_table.toml", *, feedrate_mm_per_min=None):
    """A program in the dialect of another control, its short blocks fitted by NURBS.

    Args:
        program, machine, feedrate_mm_per_min: as check() has them
        to: "g5.2", "g6.2", "fanuc" or "bspline"

    Returns:
        str, the text of the new program, which was read back and held against the old one
    """
    text, _ = _twin.convert(_program(program, feedrate_mm_per_min), _settings(machine), to)
    return text


class Plant(_twin.Plant):
    """A machine that Python moves itself, one period at a time, in simulated time.

        with twin.Plant(machine) as plant:
            plant.command((0.5, -0.2))  # V-REF of x and y [V]
            plant.advance()             # one period passes
            plant.position_mm           # x, y by the encoders
    """

    def __init__(self, machine="xy_table.toml", *, hal="mujoco", faults=()):
        super().__init__(_settings(machine), hal, list(faults))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class SetPoints(_twin.SetPoints):
    """The set points of a program, an iterator of SetPoint, one for each interpolation period.

        for point in twin.SetPoints("square.nc"):
            point.position_mm, point.velocity_mm_per_s

    The first is the start of the path, the last its end, both at rest. Nothing moves, and the travel
    is not checked.
    """

    def __init__(self, program, machine="xy_table.toml", *, feedrate_mm_per_min=None):
        super().__init__(_program(program, feedrate_mm_per_min), _settings(machine))
