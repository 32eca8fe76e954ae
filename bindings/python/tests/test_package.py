"""The package as others see it: types, the notebook."""

import subprocess
import sys
from pathlib import Path

import orthoframe

HERE = Path(__file__).resolve().parent.parent


def test_it_is_the_built_wheel_that_is_tested():
    assert HERE not in Path(orthoframe.__file__).resolve().parents


def test_the_types_are_those_of_the_compiled_part():
    """mypy's own judge of stubs, and mypy over the package and a program that uses it."""
    for command in (
        ["mypy.stubtest", "orthoframe", "--ignore-missing-stub"],
        ["mypy", "--strict", "-p", "orthoframe"],
        ["mypy", "--strict", str(HERE / "tests" / "typed.py")],
    ):
        done = subprocess.run([sys.executable, "-m", *command], capture_output=True, text=True)
        assert done.returncode == 0, done.stdout + done.stderr


def test_the_notebook_runs(tmp_path):
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.read(HERE / "examples" / "plan.ipynb", as_version=4)
    code = [cell.source for cell in notebook.cells if cell.cell_type == "code"]
    assert sum(len([line for line in cell.splitlines() if line.strip()]) for cell in code) <= 20
    NotebookClient(notebook, timeout=120, resources={"metadata": {"path": str(HERE / "examples")}}).execute()
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    assert any("image/svg+xml" in output.get("data", {}) for output in outputs), "the plan is drawn"
    told = "".join(output.get("text", "") for output in outputs)
    assert "medicine" in told.lower()
