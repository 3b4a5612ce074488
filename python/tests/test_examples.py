"""The examples run: the drawing, the notebook, the type stubs."""

import inspect
import shutil
import subprocess
import sys
from pathlib import Path

import clsmith
import pytest

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"


def test_loads_are_drawn(examples, tmp_path):
    pytest.importorskip("matplotlib")
    folder = examples / "web-pocket"
    out = tmp_path / "loads.png"
    command = [sys.executable, EXAMPLES / "loads.py", folder / "part.cls", "-o", out]
    command += ["--recipe", folder / "recipe.yaml", "--setup", folder / "shop.yaml"]
    subprocess.run(command, check=True, timeout=600)
    assert out.read_bytes().startswith(b"\x89PNG") and out.stat().st_size > 10_000


def test_the_notebook_runs(examples, tmp_path):
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    shutil.copyfile(examples / "pocket/part.cls", tmp_path / "part.cls")
    notebook = nbformat.read(EXAMPLES / "pocket.ipynb", as_version=4)
    client = nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(tmp_path)}})
    done = client.execute()
    printed = "".join(out.get("text", "") for cell in done.cells for out in cell.get("outputs", []))
    assert "lines with another feed" in printed and "CL0" in printed
    assert (tmp_path / "corrected.cls").exists()


def test_stubs_say_what_is_there():
    pytest.importorskip("mypy")
    # Every name, parameter and default of the stubs against the installed module.
    checked = subprocess.run([sys.executable, "-m", "mypy.stubtest", "clsmith", "--ignore-missing-stub", "--concise"],
                             capture_output=True, text=True, timeout=300)
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_types_of_the_stubs_fit_their_use():
    pytest.importorskip("mypy")
    command = [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", EXAMPLES / "loads.py"]
    checked = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_everything_public_has_a_docstring():
    for name in clsmith.__all__:
        thing = getattr(clsmith, name)
        if callable(thing):
            assert inspect.getdoc(thing), name


def test_typed_files_are_installed():
    folder = Path(clsmith.__file__).parent
    assert (folder / "py.typed").exists() and (folder / "__init__.pyi").exists()
