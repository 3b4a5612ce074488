"""The folder that becomes the archive: what is taken from the project, and what the command itself writes."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

PAGES = ["README.md", "CHANGELOG.md", "LICENSE-MIT", "LICENSE-APACHE"]
# What an administrator installs beside the binary: folder of the project, name in the archive.
FOLDERS = [("configs", "configs"), ("examples/hooks", "hooks"), ("examples/services", "services")]
COMPLETIONS = [("bash", "clsmith.bash"), ("zsh", "_clsmith"), ("fish", "clsmith.fish"), ("powershell", "clsmith.ps1")]
SCHEMAS = [("recipe", []), ("setup", ["--setup"]), ("select", ["--select"]), ("jobs", ["--jobs"]),
           ("material", ["--material"]), ("profile", ["--profile"])]


def version(root: Path) -> str:
    manifest = (root / "Cargo.toml").read_text("utf-8")
    return re.search(r'^version = "([^"]+)"', manifest, re.M).group(1)


def check_changelog(root: Path, number: str) -> None:
    """A release that its own list of changes does not know is not made."""
    if not re.search(rf"^## {re.escape(number)}\b", (root / "CHANGELOG.md").read_text("utf-8"), re.M):
        sys.exit(f"release: CHANGELOG.md has no section `## {number}`")


def stage(root: Path, folder: Path, target: str) -> Path:
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for name in PAGES:
        shutil.copyfile(root / name, folder / name)
    for source, name in FOLDERS:
        for path in tracked(root, source):
            place = folder / name / path.relative_to(root / source)
            place.parent.mkdir(parents=True, exist_ok=True)
            content = path.read_bytes()
            if path.suffix in {".bat", ".cmd"}:
                # As .gitattributes has it, also from a checkout that is older than that.
                content = content.replace(b"\r\n", b"\n").replace(b"\n", b"\r\n")
            if path.suffix == ".yaml":
                # The schemas stand at the top of the archive, and a folder may be less deep there than in the project.
                up = b"../" * source.count("/") + b"../"
                content = content.replace(b"$schema=" + up + b"schemas/", b"$schema=../schemas/")
            place.write_bytes(content)
            runs = path.suffix in {".sh", ".py"} and "windows" not in target
            place.chmod(0o755 if runs else 0o644)
    return folder


def tracked(root: Path, folder: str) -> list[Path]:
    """Files that belong to the project; nothing that somebody left in the folder."""
    told = subprocess.run(["git", "-C", root, "ls-files", "-z", folder], check=True, capture_output=True).stdout
    return [root / name.decode() for name in sorted(told.split(b"\0")) if name]


def add_made_text(local: Path, staged: Path) -> None:
    """Manual pages, completions and schemas, by the command itself."""
    for folder in ["man", "completions", "schemas"]:
        (staged / folder).mkdir()
    subprocess.run([local, "man", "-o", staged / "man"], check=True)
    for shell, name in COMPLETIONS:
        subprocess.run([local, "completions", shell, "-o", staged / "completions" / name], check=True)
    for name, options in SCHEMAS:
        schema = staged / "schemas" / f"clsmith-{name}.schema.json"
        subprocess.run([local, "schema", *options, "-o", schema], check=True)
