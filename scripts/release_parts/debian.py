"""The package for Debian and Ubuntu: binary, manual pages, completions, licences, hooks, services, configurations."""

import gzip
import hashlib
import os
import re
import shutil
import subprocess
from pathlib import Path

ARCHITECTURES = {"x86_64": "amd64", "aarch64": "arm64"}
DESCRIPTION = """\
reads, checks, corrects and writes cutter-location data
 clsmith stands between a CAM system's cutter-location export (Siemens NX CLSF, CATIA APT,
 Creo NCL and others) and the machine's post-processor. What a recipe does not change stays
 as it was, byte for byte."""


def pack(staged: Path, out: Path, version: str, target: str) -> list[Path]:
    if shutil.which("dpkg-deb") is None:
        print("release: no .deb, since dpkg-deb is missing")
        return []
    architecture = ARCHITECTURES[target.split("-")[0]]
    root = out / "stage" / f"deb-{architecture}"
    shutil.rmtree(root, ignore_errors=True)
    install(staged, root)
    control = root / "DEBIAN"
    control.mkdir()
    files = sorted(path for path in root.rglob("*") if path.is_file() and control not in path.parents)
    sums = "".join(f"{hashlib.md5(path.read_bytes()).hexdigest()}  {path.relative_to(root).as_posix()}\n" for path in files)
    (control / "md5sums").write_text(sums)
    size = sum((path.stat().st_size + 1023) // 1024 for path in files)
    (control / "control").write_text(
        f"Package: clsmith\nVersion: {version}\nArchitecture: {architecture}\nSection: science\nPriority: optional\n"
        f"Maintainer: {maintainer()}\nInstalled-Size: {size}\n"
        f"Depends: {depends(root / 'usr/bin/clsmith')}\nDescription: {DESCRIPTION}\n")
    for path in [root, *root.rglob("*")]:
        runs = path.is_dir() or path.stat().st_mode & 0o100
        path.chmod(0o755 if runs else 0o644)
    package = out / f"clsmith_{version}_{architecture}.deb"
    subprocess.run(["dpkg-deb", "--root-owner-group", "-Zxz", "--build", root, package], check=True,
                   stdout=subprocess.DEVNULL)
    return [package]


def maintainer() -> str:
    """Who publishes, as Debian's tools are told it; without them the holder of the copyright, who has no address."""
    name, address = os.environ.get("DEBFULLNAME", "The clsmith authors"), os.environ.get("DEBEMAIL")
    return f"{name} <{address}>" if address else name


def install(staged: Path, root: Path) -> None:
    copies = [
        ("clsmith", "usr/bin/clsmith"),
        ("completions/clsmith.bash", "usr/share/bash-completion/completions/clsmith"),
        ("completions/_clsmith", "usr/share/zsh/vendor-completions/_clsmith"),
        ("completions/clsmith.fish", "usr/share/fish/vendor_completions.d/clsmith.fish"),
        ("services/clsmith-watch@.service", "usr/lib/systemd/system/clsmith-watch@.service"),
        ("README.md", "usr/share/doc/clsmith/README.md"),
        ("sbom.cdx.json", "usr/share/doc/clsmith/sbom.cdx.json"),
    ]
    for source, place in copies:
        (root / place).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(staged / source, root / place)
    for folder in ["configs", "hooks", "services", "schemas"]:
        shutil.copytree(staged / folder, root / "usr/share/clsmith" / folder)
    documents = root / "usr/share/doc/clsmith"
    own = (staged / "LICENSE-MIT").read_text() + "\n" + (staged / "LICENSE-APACHE").read_text()
    (documents / "copyright").write_text(own + "\n" + (staged / "THIRD-PARTY.txt").read_text("utf-8"), "utf-8")
    press(staged / "CHANGELOG.md", documents / "changelog.gz")
    for page in sorted((staged / "man").iterdir()):
        press(page, root / "usr/share/man/man1" / f"{page.name}.gz")


def press(source: Path, place: Path) -> None:
    place.parent.mkdir(parents=True, exist_ok=True)
    with open(place, "wb") as raw, gzip.GzipFile("", "wb", 9, raw, mtime=0) as packed:
        packed.write(source.read_bytes())


def depends(program: Path) -> str:
    """The newest version of the C library that the binary asks for, as its own table of symbols says."""
    told = subprocess.run(["objdump", "-T", "-p", program], check=True, capture_output=True, text=True).stdout
    versions = {tuple(map(int, found.split("."))) for found in re.findall(r"GLIBC_([0-9.]+)", told)}
    needed = [f"libc6 (>= {'.'.join(map(str, max(versions)))})"]
    if "libgcc_s.so.1" in told:
        needed.append("libgcc-s1")
    return ", ".join(needed)
