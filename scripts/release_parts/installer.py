"""The installer for Windows, by NSIS."""

import shutil
import subprocess
from pathlib import Path


def pack(root: Path, staged: Path, out: Path, version: str) -> list[Path]:
    if shutil.which("makensis") is None:
        print("release: no installer, since makensis is missing (Debian's package nsis)")
        return []
    path = out / f"{staged.name}-setup.exe"
    size = sum(file.stat().st_size for file in staged.rglob("*") if file.is_file()) // 1024
    removal = out / "stage" / "uninstall-files.nsh"
    removal.write_text(removal_lines(staged), "utf-8", newline="\n")
    # Numbers of four parts are what Windows shows in a file's properties.
    four = ".".join([*version.split("-")[0].split("."), "0"])
    given = [f"-DVERSION={version}", f"-DVERSION_FOUR={four}", f"-DSTAGED={staged.resolve()}",
             f"-DOUT={path.resolve()}", f"-DSIZE_KB={size}",
             f"-DREMOVAL={removal.resolve()}"]
    subprocess.run(["makensis", "-V2", "-INPUTCHARSET", "UTF8", *given, root / "packaging/clsmith.nsi"], check=True)
    return [path]


def removal_lines(staged: Path) -> str:
    """What the uninstaller removes: the files that were installed, by name, and folders that are empty then."""
    name = lambda path: str(path.relative_to(staged)).replace("/", "\\").replace("$", "$$")  # noqa: E731
    paths = sorted(staged.rglob("*"), reverse=True)
    lines = [f'Delete "$INSTDIR\\{name(path)}"' for path in paths if path.is_file()]
    lines += [f'RMDir "$INSTDIR\\{name(path)}"' for path in paths if path.is_dir()]
    return "\n".join(lines) + "\n"
