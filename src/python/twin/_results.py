"""What a run leaves: figures and trace."""

import json
import os
from collections.abc import Mapping

from . import _twin

class Trace(Mapping):
    """The trace of a run: a mapping from column names to NumPy arrays, one value a period.

    The arrays are float64, read-only views of the memory that the run filled. They stay valid after
    the trace itself is gone. The trace has one row for each interpolation period::

        t, x = result.trace["t_s"], result.trace["x_enc_mm"]
        pandas.DataFrame(result.trace.to_dict())
    """

    def __init__(self, trace):
        self._trace = trace

    def __getitem__(self, column):
        return self._trace.column(column)

    def __iter__(self):
        return iter(self._trace.columns)

    def __len__(self):
        return len(self._trace.columns)

    def __repr__(self):
        return f"Trace({self.rows} rows, columns {', '.join(self)})"

    @property
    def columns(self):
        """Names of the columns, each with its unit at its end."""
        return self._trace.columns

    @property
    def units(self):
        """The unit of each column that has one, as UCUM writes it: ``{"x_enc_mm": "mm", ...}``."""
        return self._trace.units

    @property
    def rows(self):
        """Number of rows."""
        return self._trace.rows

    @property
    def period_s(self):
        """Time from row to row [s]."""
        return self._trace.period_s

    @property
    def is_complete(self):
        """Whether the run reached the end of the program."""
        return self._trace.is_complete

    def to_dict(self):
        """A dict of copies, which the caller may change."""
        return {column: self[column].copy() for column in self}

    def write_csv(self, folder):
        """Writes FOLDER/trace.csv, byte for byte as the command `twin run` does.

        The trace of a run that ended early becomes trace.partial.csv.
        """
        self._trace.write_csv(os.fspath(folder))


class Result:
    """How a run went.

    Attributes:
        summary: figures of the run, a dict as in summary.json
        table: the figures as text, as `twin run` prints them
        trace: the Trace, or None if none was kept
        failure: the Error that ended the run early, or None if it reached the end
        shadow: the ShadowReport of a run with a shadow, or None
    """

    def __init__(self, outcome, program, settings):
        self._json = outcome.summary
        self._origin = program, settings
        self.summary = json.loads(outcome.summary)
        self.table = outcome.table
        self.trace = None if outcome.trace is None else Trace(outcome.trace)
        self.failure = outcome.failure
        self.shadow = outcome.shadow

    def __repr__(self):
        how = "complete" if self.failure is None else f"ended early: {self.failure}"
        return f"Result({self.summary['program']}, {how})"

    def save(self, folder, trace="csv"):
        """Writes trace and summary.json into a folder, as `twin run --no-plots` does.

        Args:
            folder: made if it is missing
            trace: files of the trace: "csv", "hdf5", "both" or "none"

        Raises:
            Error: no trace was kept, or a file cannot be written
        """
        if trace not in ("csv", "hdf5", "both", "none"):
            raise _twin.Error(f'trace is "{trace}"; expected csv, hdf5, both or none')
        if self.trace is None and trace != "none":
            raise _twin.Error("this run has kept no trace: run it with keep_trace=True")
        os.makedirs(folder, exist_ok=True)
        if trace in ("csv", "both"):
            self.trace.write_csv(folder)
        if trace in ("hdf5", "both"):
            self.trace._trace.write_hdf5(*self._origin, self._json, os.fspath(folder))
        name = "summary.json" if self.failure is None else "summary.partial.json"
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(self._json)


class Identification:
    """What recordings say of a machine.

    Attributes:
        machine: the Machine of the start with everything that was identified
        parameters: a list of dicts as identify.json has them, of both axes, with value, deviation and verdict
        validations: a list of dicts as identify.json has them: what was predicted and not fitted,
            measured less simulated position beside simpler models, for each axis
        report: all of identify.json as a dict
        table: what `twin identify` prints
        toml: a machine file that says where each value is from
        notes: what was noticed and let pass, a sentence each
    """

    def __init__(self, found, machine):
        self.machine = machine
        self.report = json.loads(found.json)
        axes = [axis for axis in self.report["axis"].values() if axis is not None]
        self.parameters = [parameter for axis in axes for parameter in axis["parameters"]]
        self.validations = self.report["validations"]
        self.table = found.table
        self.toml = found.toml
        self.notes = found.notes

    def __repr__(self):
        return f"Identification({self.machine.name})"
