"""The binary: built so that no path of this machine is in it, checked, and without symbols."""

import os
import shutil
import subprocess
import sys
from pathlib import Path


def host_target() -> str:
    told = subprocess.run(["rustc", "-vV"], check=True, capture_output=True, text=True).stdout
    return next(line.split(": ")[1] for line in told.splitlines() if line.startswith("host: "))


def build(root: Path, target: str) -> Path:
    """Builds with the profile `dist` and returns where the binary is. Paths of the machine are replaced by fixed names."""
    home = Path(os.environ.get("CARGO_HOME", Path.home() / ".cargo"))
    remapped = [f"--remap-path-prefix={root}=/clsmith", f"--remap-path-prefix={home}=/cargo"]
    flags = "\x1f".join([*filter(None, [os.environ.get("CARGO_ENCODED_RUSTFLAGS")]), *remapped])
    command = ["cargo", "build", "--locked", "--profile", "dist", "--bin", "clsmith", "--target", target]
    subprocess.run(command, cwd=root, check=True, env={**os.environ, "CARGO_ENCODED_RUSTFLAGS": flags})
    folder = Path(os.environ.get("CARGO_TARGET_DIR", root / "target"))
    return folder / target / "dist" / ("clsmith.exe" if "windows" in target else "clsmith")


def check_version(local: Path, version: str) -> None:
    told = subprocess.run([local, "--version"], check=True, capture_output=True, text=True).stdout.strip()
    if told != f"clsmith {version}":
        sys.exit(f"release: {local} says `{told}`, and Cargo.toml says {version}")


def strip(built: Path, program: Path, target: str) -> None:
    """Copies the binary and takes symbols and debugging information out of the copy."""
    shutil.copyfile(built, program)
    program.chmod(0o755)
    if "msvc" in target:
        return  # What could be stripped is in a .pdb of its own.
    by_target = {"x86_64-pc-windows-gnu": "x86_64-w64-mingw32-strip"}
    tool = by_target.get(target, "strip")
    # Apple's strip has the short option only; -S alone would leave the table of symbols.
    options = ["-x"] if "apple" in target else ["--strip-all"]
    subprocess.run([tool, *options, program], check=True)
