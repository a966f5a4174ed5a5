"""Random programs of the kinds that interpreters get wrong; the same for a seed."""

import math
import random


def number(value):
    return f"{value:.4f}".rstrip("0").rstrip(".") or "0"


def drilling(rng):
    """Canned cycles in all planes, absolute and incremental, with both return levels."""
    plane, across, up = rng.choice([("G17", "XY", "Z"), ("G18", "XZ", "Y"), ("G19", "YZ", "X")])
    lines = [f"{plane} G90 G0 {up}{number(rng.uniform(-2, 8))} F100 M3 S100"]
    for _ in range(rng.randint(1, 3)):
        incremental = rng.random() < 0.3
        # LinuxCNC 2.9 feeds out along the wrong axes in G18 and G19.
        code = rng.choice(["G81", "G82", "G83", "G73", "G86"] +
                          ["G84", "G85", "G89"] * (plane == "G17"))
        r = rng.uniform(-1, 3)
        words = [rng.choice(["G98", "G99", ""]), "G91" if incremental else "G90", code,
                 f"{across[0]}{number(rng.uniform(-9, 9))}",
                 f"{up}{number(-rng.uniform(0.1, 3) if incremental else r - rng.uniform(0.1, 4))}",
                 f"R{number(r)}"]
        words += [f"Q{number(rng.uniform(0.3, 2))}"] if code in ("G83", "G73") else []
        words += ["P0.5"] if code in ("G82", "G84", "G86", "G89") else []
        words += [f"L{rng.randint(1, 3)}"] if rng.random() < 0.3 else []
        lines.append(" ".join(words))
        for _ in range(rng.randint(0, 3)):
            lines.append(rng.choice(["", "G98 ", "G99 "]) +
                         f"{rng.choice(across)}{number(rng.uniform(-9, 9))}")
        lines.append(rng.choice(["G80", f"G90 G0 {up}{number(rng.uniform(1, 9))}"]))
    return lines


def coordinates(rng):
    """Work offsets, shifts, rotation, homes and offsets of the tool, with moves between."""
    # LinuxCNC 2.9 loses an offset of the tool when the units change.
    lines = [rng.choice(["G20", "G21"]) + " G0 X0 Y0 Z0 F500"]
    axes = lambda: " ".join(f"{a}{number(rng.uniform(-9, 9))}"
                            for a in rng.sample("XYZ", rng.randint(1, 3)))
    # Nor does it keep its place when the coordinates are turned while shifted.
    turns = rng.random() < 0.4
    for _ in range(rng.randint(4, 16)):
        lines.append(rng.choice([
            lambda: f"G10 L2 P{rng.randint(0, 9)} R{number(rng.uniform(-180, 180))}",
            lambda: rng.choice(["G54", "G55", "G56"]),
        ] * turns + [
            lambda: f"G92 {axes()}", lambda: f"G52 {axes()}", lambda: f"G43.1 {axes()}",
        ] * (not turns) + [
            lambda: f"G10 L2 P{rng.randint(0, 9)} {axes()}",
            lambda: f"G10 L20 P{rng.randint(0, 9)} {axes()}",
            lambda: rng.choice(["G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"]),
            lambda: rng.choice(["G92.1", "G92.2", "G92.3"]),
            lambda: "G49",
            lambda: rng.choice(["G28.1", "G30.1", "G28", "G30"]),
            lambda: f"{rng.choice(['G28', 'G30'])} {axes()}",
            lambda: f"G90 G53 {rng.choice(['G0', 'G1'])} {axes()}",
            lambda: f"{rng.choice(['G90', 'G91'])} {rng.choice(['G0', 'G1'])} {axes()}",
            lambda: f"G17 G90 G0 X1 Y2\nG{rng.choice('23')} X4 Y2 R{number(rng.uniform(1.6, 9))} Z3",
            lambda: f"G17 G91 G3 X0 Y0 I{number(rng.uniform(1, 5))} P{rng.randint(1, 3)}",
        ])())
        lines.append(f"{rng.choice(['G90', 'G91'])} G0 {axes()}")
    return lines


def compensation(rng):
    """A contour of lines and arcs with wide corners under G41.1 or G42.1."""
    radius = rng.uniform(0.2, 2.0)
    at, heading = [0.0, 0.0], rng.uniform(-math.pi, math.pi)
    lines = [f"G0 X0 Y0 Z0 F200", f"{rng.choice(['G41.1', 'G42.1'])} D{number(2 * radius)}"]
    for i in range(rng.randint(2, 8)):
        heading += 0.0 if rng.random() < 0.2 else rng.uniform(-2.6, 2.6)
        length = rng.uniform(3 * radius, 12 * radius) if i == 0 else rng.uniform(radius, 15 * radius)
        if i > 0 and rng.random() < 0.4:
            turn = rng.choice([-1, 1])
            size = rng.uniform(0.5 * radius, 10 * radius)
            sweep = rng.uniform(0.2, 3.0)
            centre = (at[0] - turn * size * math.sin(heading), at[1] + turn * size * math.cos(heading))
            angle = math.atan2(at[1] - centre[1], at[0] - centre[0]) + turn * sweep
            end = (centre[0] + size * math.cos(angle), centre[1] + size * math.sin(angle))
            lines.append(f"G{3 if turn > 0 else 2} X{end[0]:.7f} Y{end[1]:.7f} "
                         f"I{centre[0] - at[0]:.7f} J{centre[1] - at[1]:.7f}")
            heading += turn * sweep
        else:
            end = (at[0] + length * math.cos(heading), at[1] + length * math.sin(heading))
            lines.append(f"{rng.choice(['G1', 'G1', 'G0'])} X{end[0]:.7f} Y{end[1]:.7f}")
        at = list(end)
        if rng.random() < 0.15:
            lines.append(rng.choice([f"G1 Z{number(rng.uniform(-3, 3))}", "G4 P0.1"]))
    lines.append(f"G40 G1 X{number(at[0] + 5 * radius)} Y{number(at[1] + 5 * radius)}")
    return lines


def arcs(rng):
    """Arcs in all planes: by centre, absolute and incremental, by radius, several turns, helices."""
    lines = ["G0 X0 Y0 Z0 F300"]
    for _ in range(rng.randint(1, 6)):
        plane, (a, b, c), (i, j) = rng.choice([("G17", "XYZ", "IJ"), ("G18", "ZXY", "KI"),
                                               ("G19", "YZX", "JK")])
        start = [rng.uniform(-9, 9) for _ in "ab"]
        centre = [rng.uniform(-9, 9) for _ in "ab"]
        size, angle = math.dist(start, centre), rng.uniform(-math.pi, math.pi)
        end = (centre[0] + size * math.cos(angle), centre[1] + size * math.sin(angle))
        lines.append(f"{plane} G90 G0 {a}{start[0]:.6f} {b}{start[1]:.6f}")
        motion = rng.choice(["G2", "G3"])
        turns = f" P{rng.randint(1, 3)}" if rng.random() < 0.3 else ""
        rise = f" {c}{number(rng.uniform(-5, 5))}" if rng.random() < 0.5 else ""
        if rng.random() < 0.3:
            chord = math.dist(start, end)
            words = f"R{rng.choice([-1, 1]) * chord * rng.uniform(0.51, 2):.6f}"
        elif rng.random() < 0.3:
            words = f"G90.1 {i}{centre[0]:.6f} {j}{centre[1]:.6f}"
        else:
            words = f"G91.1 {i}{centre[0] - start[0]:.6f} {j}{centre[1] - start[1]:.6f}"
        lines.append(f"{motion} {a}{end[0]:.6f} {b}{end[1]:.6f} {words}{rise}{turns}")
    return lines


def threading(rng):
    """G33, G33.1 and G76, outside and in a bore, upwards and down, with tapers and spring cuts."""
    lines = [f"G18 {rng.choice(['G20', 'G21'])} M3 S{rng.randint(50, 900)} F100"]
    x, z = rng.uniform(5, 20), rng.uniform(-5, 5)
    for _ in range(rng.randint(1, 3)):
        lines.append(f"G90 G0 X{number(x)} Y{number(rng.uniform(-1, 1))} Z{number(z)}")
        lines.append(rng.choice(["G90", "G91"]))
        words = [f"{a}{number(rng.uniform(-12, 12))}" for a in rng.choice(["Z", "XZ", "XYZ"])]
        kind = rng.choice(["G33", "G33.1", "G76", "G76"])
        if kind != "G76":
            words += [f"K{number(rng.uniform(0.1, 2))}"]
            words += ["I1.5"] if kind == "G33.1" and rng.random() < 0.5 else []
        else:
            first = rng.uniform(0.05, 0.5)
            words += [f"P{number(rng.uniform(0.2, 2))}", f"J{number(first)}",
                      f"I{number(rng.choice([-1, 1]) * rng.uniform(0.1, 3))}",
                      f"K{number(first + rng.uniform(0.1, 3))}"]
            words += [f"R{number(rng.uniform(0.5, 2.5))}"] if rng.random() < 0.5 else []
            words += [f"Q{number(rng.choice([29, 29.5, 30, rng.uniform(0, 45)]))}"] * (rng.random() < 0.6)
            words += [f"H{rng.randint(0, 3)}"] if rng.random() < 0.5 else []
            words += [f"E{number(rng.uniform(0.1, 2))}"] if rng.random() < 0.7 else []
            words += [f"L{rng.randint(0, 3)}"] if rng.random() < 0.8 else []
        lines.append(f"{kind} " + " ".join(words))
    return lines


def probing(rng):
    """Probing moves that go their whole way, and what programs do with where they have ended."""
    lines = [f"{rng.choice(['G20', 'G21'])} G0 X1 Y1 Z1 F{rng.randint(50, 900)}"]
    axes = lambda: " ".join(f"{a}{number(rng.uniform(-9, 9))}"
                            for a in rng.sample("XYZ", rng.randint(1, 3)))
    for _ in range(rng.randint(2, 8)):
        lines.append(rng.choice([
            lambda: f"G92 {axes()}", lambda: f"G10 L20 P1 {axes()}", lambda: "G92.1",
            lambda: rng.choice(["G90", "G91"]),
            lambda: "G90 G1 X[#5061 + 1] Y[#5062 - 2] Z[#5063]",
            lambda: f"G1 {axes()}",
            lambda: f"o{len(lines)} if [#5070 EQ 0]\nG0 {axes()}\no{len(lines)} endif",
        ])())
        lines.append(f"G38.{rng.randint(2, 5)} {axes()}")
        lines += [axes()] * (rng.random() < 0.3)
    return lines


def write(folder, count, seed):
    """Writes so many programs of each kind; returns their paths."""
    paths = []
    for make in (drilling, coordinates, compensation, arcs, threading, probing):
        rng = random.Random(f"{make.__name__} {seed}")
        for i in range(count):
            path = folder / f"{make.__name__}_{i}.ngc"
            path.write_text("\n".join(make(rng)) + "\n")
            paths.append(path)
    return paths
