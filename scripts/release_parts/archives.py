"""Archives whose bytes depend on their content alone, and the checksums of all files."""

import gzip
import hashlib
import tarfile
import time
import zipfile
from pathlib import Path


def pack(staged: Path, out: Path, target: str, seconds: int) -> Path:
    return pack_zip(staged, out, seconds) if "windows" in target else pack_tar(staged, out, seconds)


def files(staged: Path) -> list[Path]:
    return sorted(path for path in staged.rglob("*") if path.is_file())


def pack_tar(staged: Path, out: Path, seconds: int) -> Path:
    path = out / f"{staged.name}.tar.gz"
    with open(path, "wb") as raw, gzip.GzipFile("", "wb", 9, raw, mtime=seconds) as packed:
        with tarfile.open(fileobj=packed, mode="w", format=tarfile.USTAR_FORMAT) as archive:
            for file in files(staged):
                entry = tarfile.TarInfo(f"{staged.name}/{file.relative_to(staged).as_posix()}")
                entry.size, entry.mtime = file.stat().st_size, seconds
                entry.mode = 0o755 if file.stat().st_mode & 0o100 else 0o644
                with open(file, "rb") as content:
                    archive.addfile(entry, content)
    return path


def pack_zip(staged: Path, out: Path, seconds: int) -> Path:
    path = out / f"{staged.name}.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for file in files(staged):
            name = f"{staged.name}/{file.relative_to(staged).as_posix()}"
            entry = zipfile.ZipInfo(name, time.gmtime(seconds)[:6])
            entry.compress_type, entry.create_system, entry.external_attr = zipfile.ZIP_DEFLATED, 3, 0o644 << 16
            archive.writestr(entry, file.read_bytes())
    return path


def write_checksums(out: Path) -> list[Path]:
    """SHA256SUMS of every file of the release that stands in the folder, as `sha256sum --check` reads it."""
    path = out / "SHA256SUMS"
    made = sorted(file for file in out.iterdir() if file.is_file() and file != path)
    lines = [f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.name}\n" for file in made]
    path.write_bytes("".join(lines).encode())
    return [path]
