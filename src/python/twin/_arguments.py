"""What functions take: a program, a machine, files."""

import os

from ._machine import Machine
from ._twin import Program

SECONDS_PER_MINUTE = 60.0


def program_of(program, feedrate_mm_per_min):
    """A Program of a file's name or a Program, with its F words replaced if a feedrate is given."""
    if not isinstance(program, Program):
        program = Program.from_file(os.fspath(program))
    if feedrate_mm_per_min is not None:
        program = program.with_feedrate(feedrate_mm_per_min / SECONDS_PER_MINUTE)
    return program


def settings_of(machine):
    return (machine if isinstance(machine, Machine) else Machine(machine))._settings


def paths(given):
    """Names of one file or of several."""
    files = [given] if isinstance(given, (str, os.PathLike)) else given
    return [os.fspath(file) for file in files]
