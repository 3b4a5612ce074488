"""The page of all codes of findings."""

import json
from pathlib import Path

from .commands import say


def write(clsmith: Path, pages: Path) -> list[tuple[str, str]]:
    codes = json.loads(say(clsmith, "explain", "--json"))
    out = ["# Codes of findings\n\nEvery finding has a code, which never means anything else; `clsmith explain CODE` says the same as this page. "
           "`--allow CODE` lets one pass, `--deny CODE` makes an error of it.\n"]
    for code in codes:
        out.append(f"\n## {code['code']}\n\n**{code['severity']}**: {plain(code['meaning'])}\n\n{plain(code['explanation'])}\n\n"
                   f"*What to do:* {plain(code['help'])}\n")
    (pages / "codes.md").write_text("".join(out), "utf-8")
    return [("Codes of findings", "codes.md")]


def plain(text: str) -> str:
    """Text outside of code may hold what Markdown takes for a tag."""
    return "`".join(part if at % 2 else part.replace("<", "&lt;") for at, part in enumerate(text.split("`")))
