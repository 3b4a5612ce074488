#!/usr/bin/env python3
"""Runs batch.py on a scheduler and two workers of this machine, kills one worker in the middle, and compares with one process.

    python try-two-workers.py [PROGRAMS [BLOCKS]]     how many programs, and how many blocks of the example each has

Needs the wheel `clsmith` and `distributed`.
"""

import json
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True
HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [str(HERE), os.environ.get("PYTHONPATH")]))

import batch  # noqa: E402
from distributed import Client, LocalCluster  # noqa: E402

RECIPE = "version: 1\nunits: mm\nsteps:\n  - scale_feed: { factor: 0.5 }\n  - move_origin: { translate: [10, 0, 0] }\n"


def make_programs(folder: Path, count: int, blocks: int) -> None:
    """Programs of a pocket that is cut again and again; one of them has a mistake."""
    folder.mkdir()
    for number in range(count):
        passes = "".join(f"GOTO/{k % 90}.5000,{k % 70}.2500,-{number % 9}.0000\nFEDRAT/MMPM,{900 + k % 50}.0000\n"
                         for k in range(blocks))
        mistake = "GOTO/1.0,2.O,3.0\n" if number == 3 else ""
        (folder / f"part {number:03}.cls").write_text(f"FEDRAT/MMPM,800.0000\n{passes}{mistake}GOTO/0,0,50\n", newline="\n")


def run_serially(folder: Path, out: Path, recipe: Path) -> float:
    begun = time.monotonic()
    rows = []
    for path in sorted(folder.rglob("*.cls")):
        file = path.relative_to(folder)
        rows.append({"file": file.as_posix(), **batch.correct(str(path), str(out / file), str(recipe), None)})
    text = "".join(json.dumps(row, ensure_ascii=False) + "\n" for row in rows)
    (out / "results.jsonl").write_text(text, "utf-8", newline="\n")
    return time.monotonic() - begun


def contents(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def start_worker(address: str, folder: Path) -> subprocess.Popen:
    command = [sys.executable, "-m", "distributed.cli.dask_worker", address, "--nthreads", "1", "--no-nanny",
               "--no-dashboard", "--local-directory", str(folder)]
    with open(folder / "worker.log", "wb") as log:
        return subprocess.Popen(command, stdout=log, stderr=log)


def main() -> None:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 40
    blocks = int(sys.argv[2]) if len(sys.argv) > 2 else 20_000
    with tempfile.TemporaryDirectory() as work:
        work = Path(work)
        recipe = work / "recipe.yaml"
        recipe.write_text(RECIPE, newline="\n")
        make_programs(work / "programs", count, blocks)
        size = sum(len(content) for content in contents(work / "programs").values())
        serial = run_serially(work / "programs", work / "serial", recipe)

        with LocalCluster(n_workers=0, host="127.0.0.1", dashboard_address=None, silence_logs=50) as cluster:
            workers = []
            for name in ["one", "two"]:
                (work / name).mkdir()
                workers.append(start_worker(cluster.scheduler_address, work / name))
            try:
                with Client(cluster) as client:
                    client.wait_for_workers(2, timeout=60)
                    begun = time.monotonic()
                    batch.run(client, work / "programs", work / "both", recipe, None)
                    both = time.monotonic() - begun

                    killed_at = []

                    def kill_in_the_middle(done: int) -> None:
                        if done >= count // 3 and not killed_at:
                            workers[0].kill()
                            workers[0].wait()
                            killed_at.append(done)

                    begun = time.monotonic()
                    batch.run(client, work / "programs", work / "killed", recipe, None, kill_in_the_middle)
                    killed = time.monotonic() - begun
            finally:
                for worker in workers:
                    worker.kill()
                    worker.wait()

        expected = contents(work / "serial")
        assert len(expected) == count, "all programs but the one with the mistake, and the results"
        assert contents(work / "both") == expected, "two workers write other bytes than one process"
        assert killed_at and contents(work / "killed") == expected, "other bytes after a worker was killed"
        print(f"{count} programs, {size / 1e6:.1f} MB: one process {serial:.1f} s, two workers {both:.1f} s, "
              f"one of them killed after {killed_at[0]} programs {killed:.1f} s; the same bytes each time")


if __name__ == "__main__":
    main()
