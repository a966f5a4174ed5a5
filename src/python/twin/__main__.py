"""``python3 -m twin ...`` is the command ``twin ...``."""

import os
import shutil
import sys

NAME = "twin"


def main():
    here = os.path.dirname(os.path.abspath(__file__))
    places = [os.path.join(here, "..", "..", "bin", NAME), shutil.which(NAME)]
    program = next((place for place in places if place and os.access(place, os.X_OK)), None)
    if program is None:
        sys.exit("twin: the program is neither beside this package nor on the PATH")
    os.execv(program, [NAME, *sys.argv[1:]])


main()
