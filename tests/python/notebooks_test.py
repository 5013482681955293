"""Each notebook runs to its end; the cells check what the text says."""

import pathlib
import subprocess
import sys

import pytest

notebooks = sorted((pathlib.Path(__file__).parents[2] / "docs/notebooks").glob("*.ipynb"))


def test_there_are_some():
    assert len(notebooks) == 5


@pytest.mark.parametrize("notebook", notebooks, ids=lambda path: path.stem)
def test_it_runs(notebook, tmp_path):
    done = subprocess.run([sys.executable, "-B", "-m", "nbconvert", "--to", "notebook", "--execute",
                           "--output-dir", str(tmp_path), str(notebook)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-3000:]
