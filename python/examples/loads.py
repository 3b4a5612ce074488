"""Draws the feed and the thickest chip of each motion of a program along its path, before and after a recipe.

    python loads.py part.cls --recipe recipe.yaml --setup shop.yaml -o loads.png
"""

import argparse

import clsmith
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--recipe", required=True)
    parser.add_argument("--setup", required=True)
    parser.add_argument("-o", "--out", required=True)
    given = parser.parse_args()

    before = clsmith.read(given.program)
    after = clsmith.apply(before, given.recipe, setup=given.setup).program

    figure, (feeds, chips) = plt.subplots(2, 1, sharex=True, figsize=(9, 6), layout="constrained")
    for program, name, colour in [(before, "before", "0.6"), (after, "after", "tab:blue")]:
        loads = clsmith.simulate(program, given.setup, certified=False)
        along = np.cumsum(loads["length_mm"])
        feeds.step(along, loads["feed_mm_min"], where="pre", color=colour, label=name)
        chips.step(along, loads["chip_thickness_mm"], where="pre", color=colour, label=name)
    feeds.set_ylabel("feed, mm/min")
    chips.set_ylabel("thickest chip, mm")
    chips.set_xlabel("path, mm")
    feeds.legend()
    figure.savefig(given.out)


if __name__ == "__main__":
    main()
