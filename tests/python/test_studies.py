"""Studies from Python."""

import subprocess
import sys

import pytest
import twin


def test_circle_has_the_deviations_of_circle_json(tmp_path):
    found = twin.circle(radius_mm=5, folder=tmp_path)
    assert (tmp_path / "circle.json").exists() and (tmp_path / "circle_cw.nc").exists()
    assert found["radius_mm"] == 5
    assert twin.circle(radius_mm=5) == found


def test_compare_runs_every_program_on_every_machine():
    soft = twin.Machine(servo__x__kp_per_s=60)
    rows = twin.compare(["square.nc", "circle.nc"], {"as is": twin.Machine(), "soft": soft})
    assert [(row["program"], row["machine"]) for row in rows] == [
        ("square.nc", "as is"),
        ("square.nc", "soft"),
        ("circle.nc", "as is"),
        ("circle.nc", "soft"),
    ]
    stiff, soft = (row["summary"]["tracking_error_um"]["x"]["rms"] for row in rows[:2])
    assert soft > stiff and all(row["failure"] is None for row in rows)


@pytest.mark.slow
def test_identify_predicts_a_recording_that_was_not_fitted(tmp_path):
    text = "G21 G90\nG1 X{0} F3000\nX0\nX{0} F600\nX0\nM30\n"
    for way in (12, 9):
        twin.run(twin.Program.from_text(text.format(way)), folder=tmp_path / str(way), keep_trace=False)
    found = twin.identify(
        tmp_path / "12/trace.csv", validate=tmp_path / "9/trace.csv", evaluations=1
    )
    assert {p["key"].split(".")[1] for p in found.parameters} == {"x"}
    (validation,) = found.validations
    assert validation["axis"] == "x" and not validation["held_out"]
    held_out = twin.identify(tmp_path / "12/trace.csv", evaluations=1).validations
    assert all(one["held_out"] for one in held_out)


def test_converted_program_takes_the_same_way():
    text = twin.convert("oxalis.nc", "g6.2")
    converted = twin.check(twin.Program.from_text(text, "converted.nc"))
    original = twin.check("oxalis.nc")
    assert converted["length_mm"] == pytest.approx(original["length_mm"], rel=1e-3)
    with pytest.raises(twin.Error, match="unknown dialect g9"):
        twin.convert("oxalis.nc", "g9")


def test_the_package_is_the_command_too():
    said = subprocess.run(
        [sys.executable, "-m", "twin", "--version"], stdout=subprocess.PIPE, text=True, check=True
    ).stdout
    assert "twin" in said


def test_tune_finds_better_gains_and_goes_on_from_its_store(tmp_path):
    (tmp_path / "short.nc").write_text("G21 G90\nG1 X4 F3000\nY3\nG0 X0 Y0\nM30\n")
    options = dict(vary={"servo.y.kp_per_s": (60, 300)}, trials=12)
    machine = twin.Machine(**{"servo.x.kp_per_s": 150, "servo.y.kp_per_s": 70})
    tuned = twin.tune(tmp_path / "short.nc", machine, folder=tmp_path / "out", **options)
    assert tuned.report["after"]["contour_error_max_um"] < tuned.report["before"]["contour_error_max_um"]
    assert tuned.machine["servo.y.kp_per_s"] == pytest.approx(tuned.settings["servo.y.kp_per_s"])
    assert min(tuned.report["after"]["loops"][axis]["gain_margin_dB"] for axis in "xy") >= 6
    again = twin.tune(tmp_path / "short.nc", machine, folder=tmp_path / "out", **options)
    assert again.report == tuned.report and "0 runs computed" in again.table
    with pytest.raises(twin.Error, match="did you mean"):
        twin.tune("square.nc", folder=tmp_path / "x", vary={"servo.y.kp_per_m": (60, 300)})


def test_report_writes_the_page_of_runs(tmp_path):
    program = twin.Program.from_text("G21 G90\nG1 X2 F1200\nM30\n", "own.nc")
    result = twin.run(program)
    result.save(tmp_path / "a", trace="hdf5")
    result.save(tmp_path / "b")
    page = twin.report(tmp_path / "a", programs=[program])
    assert page == str(tmp_path / "a" / "report.html")
    assert "is not where it was" not in open(page).read()
    assert "is not where it was" in open(twin.report(tmp_path / "b")).read()  # the program is not given
    both = twin.report([tmp_path / "a", tmp_path / "b"], tmp_path / "both.html")
    assert "<html" in open(both).read()
    with pytest.raises(twin.Error, match="is this the folder of a run"):
        twin.report(tmp_path)


@pytest.mark.slow
def test_a_corrected_run_is_nearer_to_its_path_and_another_program_is_refused(tmp_path):
    program = twin.Program.from_text("G21 G90\nG1 X8 Y3 F3000\nY9\nX0 Y0\nM30\n")
    made = twin.compensate(program, file=tmp_path / "c.csv")
    assert made["max_um"][1] < 0.6 * made["max_um"][0]
    plain = twin.run(program).summary["contour_error_um"]["rms"]
    corrected = twin.run(program, correction=tmp_path / "c.csv").summary["contour_error_um"]["rms"]
    assert corrected < 0.9 * plain
    other = twin.Program.from_text("G21 G90\nG1 X8 Y3 F3000\nM30\n")
    with pytest.raises(twin.Error, match="another program"):
        twin.run(other, correction=tmp_path / "c.csv")
    twin.run(program, learn=tmp_path / "learnt", keep_trace=False)
    assert (tmp_path / "learnt/learnt.csv").read_text().startswith("# twin learnt 1, runs = 1")


@pytest.mark.slow
def test_a_shadow_is_silent_on_a_healthy_run_and_names_a_change(tmp_path):
    healthy = [tmp_path / name for name in ("dolphin", "butterfly")]
    for folder in healthy:
        twin.run(f"{folder.name}.nc", folder=folder, keep_trace=False, feedrate_mm_per_min=3000)
    traces = [folder / "trace.csv" for folder in healthy]
    assert "axis x" in twin.learn_shadow(traces, file=tmp_path / "healthy.json")
    shadow = tmp_path / "healthy.json"
    assert [report.findings for report in twin.watch(traces, learnt=shadow)] == [[], []]
    changed = twin.Machine()
    changed["table.x.vref_scale_rpm_per_V"] = 475.0
    twin.run("dolphin.nc", changed, folder=tmp_path / "run", feedrate_mm_per_min=3000)
    (report,) = twin.watch(tmp_path / "run/trace.csv", learnt=shadow)
    (found,) = report.findings
    assert (found.axis, found.cause) == ("x", "vref_gain") and "axis x" in str(found)
    assert found.change == pytest.approx(-0.05, abs=0.01)
    live = twin.run("square.nc", shadow=shadow, keep_trace=False)
    assert live.failure is None and live.shadow.switched_off == "" and live.shadow.findings == []
