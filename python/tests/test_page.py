"""Every box of Python of the documentation's page runs."""

import contextlib
import io
import re
import shutil
from pathlib import Path

PAGE = Path(__file__).resolve().parents[2] / "docs/python.md"


def test_the_page_runs(examples, tmp_path, monkeypatch):
    shutil.copyfile(examples / "pocket/part.cls", tmp_path / "part.cls")
    monkeypatch.chdir(tmp_path)
    boxes = re.findall(r"^```python\n(.*?)^```$", PAGE.read_text("utf-8"), re.M | re.S)
    assert len(boxes) == 6
    names = {}
    for box in boxes:
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(box, str(PAGE), "exec"), names)
        assert printed.getvalue().strip() or "write(" in box, box
    assert (tmp_path / "edited.cls").exists() and (tmp_path / "corrected.cls").exists()
    assert names["edited"].to_bytes().count(b"COOLNT/ON") == names["program"].to_bytes().count(b"COOLNT/ON") + 1
