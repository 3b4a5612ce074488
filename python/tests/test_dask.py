"""Two workers, one of which is killed in the middle, write the same bytes as one process."""

import os
import subprocess
import sys

import pytest


@pytest.mark.skipif(os.name == "nt", reason="tried on Linux and macOS")
def test_a_killed_worker_loses_nothing(examples):
    pytest.importorskip("distributed")
    command = [sys.executable, examples / "cluster/dask/try-two-workers.py", "24", "4000"]
    ran = subprocess.run(command, capture_output=True, text=True, timeout=600)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert "the same bytes each time" in ran.stdout
