"""Asks LinuxCNC's interpreter, by its Python module gcode (package linuxcnc-uspace), for moves.

As a program it prints the answer for a file as JSON: the module may crash or never end.
"""

import collections
import json
import math
import os
import subprocess
import sys
import tempfile

import gcode

START = "G21 G17 G90 G94 G64 G54 G40 G49 G80 G92.1 G98"
MM = 25.4  # the module counts in inches
AXES = {1: (0, 1, 2), 3: (2, 0, 1), 2: (1, 2, 0)}  # of its planes, in right-handed order

# kind is rapid, linear, arc or rest; end is on the machine [mm]; size is the length [mm] or time [s]
Move = collections.namedtuple("Move", "line kind end size")


class Canon:
    """Takes the canonical calls of a program and keeps its moves in machine coordinates."""

    def __init__(self):
        self.moves, self.notes = [], set()
        self.shift, self.origin, self.tool = [0.0] * 9, [0.0] * 9, [0.0] * 9
        self.turn, self.plane, self.line = 0.0, 1, 0
        self.at = [0.0] * 3

    def to_machine(self, place):
        x, y, z = (place[i] + self.shift[i] for i in range(3))
        s, c = math.sin(self.turn), math.cos(self.turn)
        turned = (x * c - y * s, x * s + y * c, z)
        return [turned[i] + self.origin[i] + self.tool[i] for i in range(3)]

    def to_program(self, place):
        x, y, z = (place[i] - self.origin[i] - self.tool[i] for i in range(3))
        s, c = math.sin(self.turn), math.cos(self.turn)
        turned = (x * c + y * s, -x * s + y * c, z)
        return [turned[i] - self.shift[i] for i in range(3)]

    def add(self, kind, end, length):
        self.moves.append(Move(self.line, kind, [MM * v for v in end], MM * length))
        self.at = end

    def straight_traverse(self, *place):
        end = self.to_machine(place)
        self.add("rapid", end, math.dist(self.at, end))

    def straight_feed(self, *place):
        end = self.to_machine(place)
        self.add("linear", end, math.dist(self.at, end))

    def straight_probe(self, *place):
        self.straight_feed(*place)

    def rigid_tap(self, x, y, z, *rest):
        start, end = self.at, self.to_machine((x, y, z))
        self.add("linear", end, math.dist(start, end))
        self.add("linear", start, math.dist(start, end))

    def arc_feed(self, first, second, centre_first, centre_second, turns, third, *rest):
        i, j, k = AXES[self.plane]
        start = self.to_program(self.at)
        end = [0.0] * 3
        end[i], end[j], end[k] = first, second, third
        u = (start[i] - centre_first, start[j] - centre_second)
        v = (first - centre_first, second - centre_second)
        before, after = math.hypot(*u), math.hypot(*v)
        sense = 1 if turns > 0 else -1
        sweep = sense * (math.atan2(v[1], v[0]) - math.atan2(u[1], u[0])) % (2 * math.pi)
        if sweep * before < 1e-9 or (2 * math.pi - sweep) * before < 1e-9:
            sweep = 2 * math.pi
        sweep += 2 * math.pi * (abs(turns) - 1)
        around = 0.5 * (before + after) * sweep
        self.add("arc", self.to_machine(end),
                 math.sqrt(around ** 2 + (after - before) ** 2 + (end[k] - start[k]) ** 2))

    def dwell(self, time):
        self.moves.append(Move(self.line, "rest", [MM * v for v in self.at], time))

    def change_tool(self, index):
        self.moves.append(Move(self.line, "rest", [MM * v for v in self.at], 0.0))

    def set_g5x_offset(self, index, *place):
        self.origin = place

    def set_g92_offset(self, *place):
        self.shift = place

    def set_xy_rotation(self, angle):
        self.turn = math.radians(angle)

    def tool_offset(self, *place):
        self.tool = place

    use_tool_offset = tool_offset

    def set_plane(self, plane):
        self.plane = plane

    def next_line(self, state):
        self.line = state.sequence_number

    def user_defined_function(self, *words):
        pass

    def set_feed_rate(self, rate):
        pass

    def set_feed_mode(self, *mode):
        pass

    def set_traverse_rate(self, rate):
        pass

    def comment(self, text):
        pass

    def message(self, text):
        pass

    def check_abort(self):
        return False

    def get_external_length_units(self):
        return 1.0

    def get_external_angular_units(self):
        return 1.0

    def get_axis_mask(self):
        return 7

    def get_block_delete(self):
        return True

    def get_tool(self, index):
        return (-1,) + (0.0,) * 12 + (0,)


def ask(path):
    """Returns the moves of a program, the error or "", and what of it is not modelled here."""
    canon = Canon()
    with tempfile.TemporaryDirectory() as folder:
        canon.parameter_file = os.path.join(folder, "parameters")
        open(canon.parameter_file, "w").close()
        result, line = gcode.parse(str(path), canon, START, "")
    error = gcode.strerror(result) if result > gcode.MIN_ERROR else ""
    return canon.moves, f"{line}: {error}" if error else "", canon.notes


def ask_apart(path, seconds=20):
    """The same in a process of its own; None if it crashes, or does not end in time."""
    try:
        result = subprocess.run([sys.executable, __file__, str(path)], capture_output=True,
                                stdin=subprocess.DEVNULL, timeout=seconds)
        moves, error, notes = json.loads(result.stdout.splitlines()[-1])
    except (subprocess.TimeoutExpired, ValueError, IndexError):
        return None
    return [Move(*move) for move in moves], error, set(notes)


if __name__ == "__main__":
    moves_, error_, notes_ = ask(sys.argv[1])
    print()
    print(json.dumps([moves_, error_, sorted(notes_)]))
