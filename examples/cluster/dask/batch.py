#!/usr/bin/env python3
"""Corrects programs on the workers of a Dask cluster, each by the wheel `clsmith`.

    dask scheduler --port 8786                      on one machine
    dask worker tcp://HOST:8786 --nthreads 1        on each, as often as it may work at once
    python batch.py tcp://HOST:8786 --recipe /shop/slow-entry.yaml --out /shop/done /shop/programs

All see the same disk under the same paths. A worker that goes away loses nothing: Dask gives its programs to another, and an
output appears whole or not at all. `results.jsonl` has a line for each program, sorted, the same whatever worker did it.
"""

import argparse
import hashlib
import json
import sys
from pathlib import Path


def correct(path: str, target: str, recipe: str, setup: str | None) -> dict:
    """Corrects one program, on a worker."""
    import clsmith

    try:
        corrected = clsmith.apply(path, recipe, setup=setup)
    except clsmith.ClsmithError as error:
        # What an earlier run wrote is not this program's any more.
        Path(target).unlink(missing_ok=True)
        return {"outcome": "refused", "code": error.code, "line": error.line, "message": error.message}
    Path(target).parent.mkdir(parents=True, exist_ok=True)
    corrected.program.write(target)
    digest = hashlib.sha256(corrected.program.to_bytes()).hexdigest()
    return {"outcome": "corrected", "sha256": digest, "findings": [found.code for found in corrected.findings]}


def run(client, folder: Path, out: Path, recipe: Path, setup: Path | None, on_done=lambda done: None) -> list[dict]:
    """Corrects all programs below a folder; `on_done` gets the number of those that are done."""
    from distributed import as_completed

    files = sorted(path.relative_to(folder) for path in folder.rglob("*") if path.suffix in {".cls", ".ncl", ".aptsource"})
    if not files:
        sys.exit(f"{folder}: no program with .cls, .ncl or .aptsource")
    fixed = {"recipe": str(recipe), "setup": str(setup) if setup else None}
    # Pure would mean that Dask may take an older result of the same names.
    futures = [client.submit(correct, str(folder / file), str(out / file), pure=False, **fixed) for file in files]
    for done, _ in enumerate(as_completed(futures), start=1):
        on_done(done)
    rows = [{"file": file.as_posix(), **future.result()} for file, future in zip(files, futures)]
    out.mkdir(parents=True, exist_ok=True)
    text = "".join(json.dumps(row, ensure_ascii=False) + "\n" for row in rows)
    (out / "results.jsonl").write_text(text, "utf-8", newline="\n")
    return rows


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scheduler")
    parser.add_argument("programs", type=Path)
    parser.add_argument("--recipe", type=Path, required=True)
    parser.add_argument("--setup", type=Path)
    parser.add_argument("--out", type=Path, required=True)
    given = parser.parse_args()

    from distributed import Client

    absolute = lambda path: path and path.resolve()  # noqa: E731
    with Client(given.scheduler) as client:
        rows = run(client, *map(absolute, [given.programs, given.out, given.recipe, given.setup]))
    refused = sum(row["outcome"] == "refused" for row in rows)
    print(f"{len(rows) - refused} corrected, {refused} refused")
    sys.exit(1 if refused else 0)


if __name__ == "__main__":
    main()
