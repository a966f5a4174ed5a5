"""The twin beside the machine: corrections of the command, and the shadow."""

import os

from . import _twin
from ._arguments import paths, program_of, settings_of


def compensate(program, machine="xy_table.toml", *, file, feedrate_mm_per_min=None):
    """Finds the shifts of the set points by which the identified table meets the programmed path.

    Args:
        program, machine, feedrate_mm_per_min: as check() has them
        file: gets the correction, for run(correction=file)

    Returns:
        dict with the contour error of the model's table in um, mean over phases of encoder and hum:
        max_um and rms_um, each a pair of without and with the correction; and iterations
    """
    made = _twin.compensate(program_of(program, feedrate_mm_per_min), settings_of(machine), os.fspath(file))
    um = [1e3 * value for value in made[:4]]
    return {"max_um": (um[0], um[1]), "rms_um": (um[2], um[3]), "iterations": made[4]}


def learn_shadow(traces, machine="xy_table.toml", *, file, columns=""):
    """Learns what healthy runs of a machine are like.

    Args:
        traces: a CSV or HDF5 file, or several
        machine: the machine they were recorded on
        file: gets what was learnt, for watch() and run(shadow=file)
        columns: as identify() has them

    Returns:
        str: what was learnt, a line for each axis and signal
    """
    return _twin.learn_shadow(paths(traces), settings_of(machine), os.fspath(file), columns)


def watch(traces, machine="xy_table.toml", *, learnt=None, columns=""):
    """Lets the identified model run beside recorded runs and says what has changed of the machine.

    Args:
        traces, machine, columns: as learn_shadow() has them
        learnt: file of learn_shadow(); None: what the model alone knows

    Returns:
        list of ShadowReport, one for each recording
    """
    learnt = "" if learnt is None else os.fspath(learnt)
    return _twin.watch(paths(traces), settings_of(machine), learnt, columns)
