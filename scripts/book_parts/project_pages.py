"""Pages that stand elsewhere in the project and belong into the site: records by dialect, setups, architecture, changes."""

import re
import shutil
from pathlib import Path

PAGES = [
    ("What becomes of each record", "grammar/RECORDS.md", "records.md"),
    ("Setups, explained", "configs/README.md", "setups.md"),
    ("Many machines", "examples/cluster/README.md", "cluster.md"),
    ("Hooks", "examples/hooks/README.md", "hooks/index.md"),
    ("Hook for Siemens NX", "examples/hooks/nx/README.md", "hooks/nx.md"),
    ("Hook for CATIA V5", "examples/hooks/catia/README.md", "hooks/catia.md"),
    ("Hook for Creo NC", "examples/hooks/creo/README.md", "hooks/creo.md"),
    ("Watch as a service", "examples/services/README.md", "services.md"),
    # The part of the page that is about the library.
    ("The library", "README.md", "library.md"),
    ("Architecture", "ARCHITECTURE.md", "architecture.md"),
    ("Contributing", "CONTRIBUTING.md", "contributing.md"),
    ("Figures of speed", "benches/README.md", "benches.md"),
    ("Changes", "CHANGELOG.md", "changes.md"),
]


def write(root: Path, pages: Path, api: Path | None) -> list[tuple[str, str]]:
    """`api` is what `cargo doc` made; it is taken in whole, behind a link on the library's page."""
    place = {(root / source).resolve(): pages / name for _, source, name in PAGES}
    for _, source, name in PAGES:
        (pages / name).parent.mkdir(parents=True, exist_ok=True)
        text = (root / source).read_text("utf-8")
        if source == "README.md":
            text = text[text.index("## The library"):].replace("## The library", "# The library")
        text = relink(text, root / source, pages / name, place, pages)
        if source == "README.md" and api:
            shutil.copytree(api, pages / "api")
            text = text.replace("`cargo doc --open` begins", "[Every item of it](api/clsmith/index.html) begins")
        (pages / name).write_text(text, "utf-8")
    return [(title, name) for title, _, name in PAGES]


def relink(text: str, source: Path, page: Path, place: dict, pages: Path) -> str:
    """Links to pages that the site has lead there, images come along, and what the site has not is named as a path."""

    def link(found: re.Match) -> str:
        image, label, target = found.groups()
        file, _, anchor = target.partition("#")
        if "://" in target or not file:
            return found.group(0)
        wanted = (source.parent / file).resolve()
        if wanted in place:
            up = Path(*[".."] * len(page.parent.relative_to(pages).parts)) if page.parent != pages else Path(".")
            there = (up / place[wanted].relative_to(pages)).as_posix()
            return f"{image}[{label}]({there}{'#' + anchor if anchor else ''})"
        if image:
            shutil.copyfile(wanted, page.parent / wanted.name)
            return f"![{label}]({wanted.name})"
        return label

    blocks = re.split(r"(^```.*?^```\s*?$)", text, flags=re.M | re.S)
    pattern = re.compile(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)")
    return "".join(block if at % 2 else pattern.sub(link, block) for at, block in enumerate(blocks))
