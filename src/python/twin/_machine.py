"""Settings of a machine and of its controller, as a mapping."""

import os
import tomllib
from collections.abc import Mapping

from . import _twin


def _toml_value(value):
    """A value as a machine file writes it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return value
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml_value(item) for item in value) + "]"
    return repr(float(value)) if not isinstance(value, int) else str(value)


class Section(Mapping):
    """A part of a machine's settings, as in ``machine["servo"]["x"]``; it shows changes at once."""

    def __init__(self, machine, path):
        self._machine = machine
        self._path = path

    def _values(self):
        values = self._machine._values()
        for name in self._path:
            values = values[name]
        return values

    def __getitem__(self, name):
        value = self._values()[name]
        return Section(self._machine, (*self._path, name)) if isinstance(value, dict) else value

    def __setitem__(self, name, value):
        self._machine[".".join((*self._path, name))] = value

    def __iter__(self):
        return iter(self._values())

    def __len__(self):
        return len(self._values())

    def __repr__(self):
        return f"Section({'.'.join(self._path)!r}, {self._values()!r})"


class Machine(Mapping):
    """All settings of a machine and of its controller: the contents of a machine file.

    Keys are "SECTION.NAME", and the name ends with its unit::

        machine = twin.Machine("xy_table.toml")
        machine["limits.jerk_mm_per_s3"] = 20000
        machine["servo"]["x"]["kp_per_s"]

    A value is a float, an int, a bool, a str or a list of floats, in the unit that its key names.
    """

    def __init__(self, machine="xy_table.toml", /, **changes):
        """Reads a machine file, or copies a machine.

        Args:
            machine: path of a machine file, or its name if the program brings it; or a Machine
            changes: settings to change, with "__" in place of dots: ``servo__x__kp_per_s=200``

        Raises:
            Error: there is no such file, it is wrong, or a setting is
        """
        if isinstance(machine, Machine):
            self._settings = _twin.Settings(machine._settings)
        elif isinstance(machine, _twin.Settings):
            self._settings = machine
        else:
            self._settings = _twin.Settings(os.fspath(machine))
        self._known = None  # what to_dict() gave, until a setting changes
        for key, value in changes.items():
            self[key.replace("__", ".")] = value

    def set(self, key, value):
        """Changes a setting; the name may leave out its unit. Returns this machine.

        Raises:
            Error: the key is unknown or the value is out of range; nothing has changed then
        """
        self._settings.set(f"{key}={_toml_value(value)}")
        self._known = None
        return self

    def replace(self, changes):
        """A copy with some settings changed. Args: changes: a mapping of keys to values."""
        copy = Machine(self)
        for key, value in changes.items():
            copy.set(key, value)
        return copy

    def __setitem__(self, key, value):
        self.set(key, value)

    def _values(self):
        if self._known is None:
            self._known = self.to_dict()
        return self._known

    def __getitem__(self, key):
        values = self._values()
        path = key.split(".")
        for name in path:
            if not isinstance(values, dict) or name not in values:
                break
            values = values[name]
        else:
            return Section(self, tuple(path)) if isinstance(values, dict) else values
        try:
            self._settings.text(key)  # refuses what is no key, and knows the nearest one
        except _twin.Error as error:
            raise KeyError(error.message) from None
        full = next(name for name in self if name.startswith(key + "_"))
        return self[full]

    def __contains__(self, key):
        try:
            self[key]
        except KeyError:
            return False
        return True

    def __iter__(self):
        return iter(self._settings.keys())

    def __len__(self):
        return len(self._settings.keys())

    def __eq__(self, other):
        return isinstance(other, Machine) and self.to_dict() == other.to_dict()

    __hash__ = None

    def __repr__(self):
        return f"Machine({self.name!r})"

    def __getstate__(self):
        return {"name": self.name, "settings": {key: self[key] for key in self}}

    def __setstate__(self, state):
        self._settings = _twin.Settings(state["name"] + ".toml")
        self._known = None
        for key, value in state["settings"].items():
            self[key] = value

    @property
    def name(self):
        """Name of the machine file without folder and ending."""
        return self._settings.name

    @property
    def notes(self):
        """Settings that were changed because they do not fit the others, a sentence each."""
        return self._settings.notes()

    def to_dict(self):
        """All settings as nested dicts, as the machine file has them."""
        return tomllib.loads(self._settings.toml())

    def to_toml(self):
        """All settings as the text of a machine file, each with its meaning and its range."""
        return self._settings.toml()

    def save(self, file):
        """Writes a machine file."""
        with open(file, "w", encoding="utf-8") as output:
            output.write(self.to_toml())
