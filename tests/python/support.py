"""What the tests share."""

import os

EXECUTABLE = os.environ["TWIN_EXECUTABLE"]
