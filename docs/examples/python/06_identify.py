"""Records a run of a machine and finds its friction again from the trace."""

import pathlib
import tempfile

import twin

TEXT = "G21 G90\nG1 X30 F4500\nX0\nX20 F900\nX12\nX14 F120\nX10\nX0 F3000\nM30\n"
hidden = twin.Machine("xy_table.toml").set("table.x.coulomb_friction_N", 14.0)
with tempfile.TemporaryDirectory() as folder:
    twin.run(twin.Program.from_text(TEXT), hidden, folder=folder, keep_trace=False)
    found = twin.identify(pathlib.Path(folder, "trace.csv"), twin.Machine(), evaluations=40)
print(f"Coulomb friction of x: {found.machine['table.x.coulomb_friction_N']:.1f} N")
