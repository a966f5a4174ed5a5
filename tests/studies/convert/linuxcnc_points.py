"""Prints the places in mm to which LinuxCNC's interpreter feeds in a program, one a line."""
import os
import sys

import gcode


class Canon:
    def __init__(self):
        self.parameter_file = sys.argv[2]
        self.places = []

    def straight_feed(self, x, y, z, *_):
        self.places.append((25.4 * x, 25.4 * y, 25.4 * z))

    def get_external_length_units(self):
        return 1.0

    def get_external_angular_units(self):
        return 1.0

    def get_axis_mask(self):
        return 7

    def get_tool(self, _):
        return (-1,) + (0.0,) * 12 + (0,)

    def get_block_delete(self):
        return False

    def is_external_query(self):
        return False

    def check_abort(self):
        return False

    def __getattr__(self, name):
        return lambda *_: None


canon = Canon()
result, line = gcode.parse(sys.argv[1], canon, "G21", "")
if result > gcode.MIN_ERROR:
    sys.exit("line %d: %s" % (line, gcode.strerror(result)))
for place in canon.places:
    print("%.9f %.9f %.9f" % place)
sys.stdout.flush()
os._exit(0)
