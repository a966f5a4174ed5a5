"""The notebook runs from its first cell to its last."""

import json
import os
import pathlib

import pytest

NOTEBOOK = pathlib.Path(__file__).parents[2] / "docs" / "examples" / "python" / "tour.ipynb"


def test_notebook_is_kept_without_results():
    cells = json.loads(NOTEBOOK.read_text())["cells"]
    assert all(not cell.get("outputs") for cell in cells)


@pytest.mark.slow
def test_notebook_runs(tmp_path):
    nbformat = pytest.importorskip("nbformat", reason="jupyter-nbconvert is not installed")
    preprocessors = pytest.importorskip(
        "nbconvert.preprocessors", reason="jupyter-nbconvert is not installed"
    )
    pytest.importorskip("matplotlib", reason="python3-matplotlib is not installed")
    pytest.importorskip("ipykernel", reason="python3-ipykernel is not installed")
    os.environ["JUPYTER_PLATFORM_DIRS"] = "1"
    os.environ["HOME"] = str(tmp_path)  # nobody's settings, and no history
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    preprocessors.ExecutePreprocessor(timeout=120, kernel_name="python3").preprocess(
        notebook, {"metadata": {"path": str(tmp_path)}}
    )
    said = "".join(
        output.get("text", "") for cell in notebook.cells for output in cell.get("outputs", [])
    )
    assert "contour error at most" in said and "circular hysteresis" in said
    pictures = [
        output
        for cell in notebook.cells
        for output in cell.get("outputs", [])
        if "image/png" in output.get("data", {})
    ]
    assert len(pictures) == 2
