"""Reads a program of so many MB into arrays and says how fast: `python read_arrays.py [MB]`, by the clock, best of three."""

import sys
import tempfile
import time
from pathlib import Path

import clsmith


def main() -> None:
    size = int(sys.argv[1]) if len(sys.argv) > 1 else 100
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "long.cls"
        with open(path, "w", newline="\n") as out:
            out.write("FEDRAT/MMPM,900.0000\n")
            count = 0
            while out.tell() < size * 1_000_000:
                lines = (f"GOTO/{k % 977 * 0.25:.4f},{k % 613 * 0.5:.4f},-{k % 31 * 0.125:.4f}\n"
                         for k in range(count, count + 10_000))
                out.write("".join(lines))
                count += 10_000
        megabytes = path.stat().st_size / 1e6
        best = None
        for _ in range(3):
            begun = time.monotonic()
            program = clsmith.read(path)
            parsed = time.monotonic() - begun
            motions = program.motions()
            whole = time.monotonic() - begun
            assert len(motions) == count
            if best is None or whole < best[1]:
                best = (parsed, whole)
            del program, motions
        print(f"{megabytes:.0f} MB, {count} motions: read {best[0]:.2f} s, with arrays {best[1]:.2f} s, "
              f"{megabytes / best[1]:.0f} MB/s")


if __name__ == "__main__":
    main()
