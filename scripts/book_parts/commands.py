"""One page of each command: its help."""

import os
import re
import subprocess
from pathlib import Path


def say(clsmith: Path, *words: str) -> str:
    """What the command prints, without colours and as wide as a page."""
    environment = {**os.environ, "NO_COLOR": "1", "COLUMNS": "96"}
    return subprocess.run([clsmith, *words], check=True, capture_output=True, text=True, env=environment).stdout


def write(clsmith: Path, pages: Path) -> list[tuple[str, str]]:
    (pages / "commands").mkdir()
    names = re.findall(r"^  ([a-z-]+)  ", say(clsmith, "--help").split("Commands:")[1], re.M)
    listed = []
    for name in names:
        if name == "help":
            continue
        text = say(clsmith, name, "--help").rstrip()
        (pages / "commands" / f"{name}.md").write_text(f"# clsmith {name}\n\n```text\n{text}\n```\n", "utf-8")
        listed.append((f"clsmith {name}", f"commands/{name}.md"))
    return listed
