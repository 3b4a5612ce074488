"""The list of all pages, in which the generated ones take the place of their mark."""

import re
from pathlib import Path


def fill(pages: Path, lists: dict[str, list[tuple[str, str]]]) -> None:
    """Puts `  - [title](path)` lines where SUMMARY.md has `<!-- NAME -->`; papers.md is named where it is there."""
    summary = pages / "SUMMARY.md"
    text = summary.read_text("utf-8")
    lists = {**lists, "papers": [("Papers", "papers.md")] if (pages / "papers.md").exists() else []}

    def lines(found: re.Match) -> str:
        indent, name = found.groups()
        return "".join(f"{indent}- [{title}]({path})\n" for title, path in lists.pop(name))

    text = re.sub(r"^( *)<!-- (\w+) -->\n", lines, text, flags=re.M)
    if lists:
        raise SystemExit(f"book: SUMMARY.md has no mark for {', '.join(lists)}")
    summary.write_text(text, "utf-8")
