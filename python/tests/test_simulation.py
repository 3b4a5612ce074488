"""Loads and engagements against closed forms."""

import clsmith
import numpy as np
import pytest


def test_a_slot_has_the_loads_of_a_slot(slot, shop):
    run = clsmith.simulate(slot, shop)
    (line,) = run["line"][run["length_mm"] > 0]
    assert line == 6
    cut = run["length_mm"] > 0
    # Feed a tooth: 1000 / (5000 * 4).
    assert run["chip_thickness_mm"][cut][0] == pytest.approx(0.05, rel=1e-3)
    assert run["chip_thickness_bound_mm"][cut][0] >= run["chip_thickness_mm"][cut][0]
    assert run["axial_depth_mm"][cut][0] == pytest.approx(2.0)
    assert run["radial_depth_mm"][cut][0] == pytest.approx(10.0, abs=2 * run.cell_mm)
    before, removed, left = run.volumes_mm3
    assert before == pytest.approx(60 * 40 * 10) and removed + left == pytest.approx(before)
    # The slot from the edge of the block: 30 mm and half a disc.
    assert removed == pytest.approx(2 * (30 * 10 + np.pi * 25 / 2), rel=0.02)
    assert run.faults == (0, 0, 0)


def test_frames_take_the_columns(slot, shop):
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(clsmith.simulate(slot, shop, certified=False).columns)
    assert list(frame.columns[:3]) == ["line", "operation", "tool"]
    assert frame["axial_depth_mm"].max() == pytest.approx(2.0)


def test_engagement_has_a_row_for_each_motion(slot, shop):
    engaged = clsmith.engagement(slot, shop)
    motions = clsmith.read(slot).motions()
    assert engaged.removed_mm3.shape == (len(motions),) and engaged.advance_ratio.shape == (len(motions), 120)
    assert engaged.removed_mm3[0] == 0 and not engaged.advance_ratio[0].any()
    assert engaged.axial_depth_mm[-1] == pytest.approx(2.0)
    # The flank from the bottom up to the top of the stock.
    assert np.nanmin(engaged.low_mm[-1]) == pytest.approx(5.0, abs=0.01)
    assert np.nanmax(engaged.high_mm[-1]) == pytest.approx(7.0, abs=0.01)


@pytest.mark.parametrize("cell_mm", [0.2, 0.1, 0.05])
def test_a_slot_is_engaged_as_the_cosine(slot, shop, cell_mm):
    engaged = clsmith.engagement(slot, shop, cell_mm=cell_mm)
    ratio, bound = engaged.advance_ratio[-1], engaged.advance_ratio_bound[-1]
    radius, degrees = 5.0, -180 + 3 * np.arange(121)
    # In front the wall of a slot advances as the cosine of the direction; behind there is none.
    front, behind = np.abs(degrees[:-1] + 1.5) < 90, np.abs(degrees[:-1] + 1.5) > 90
    assert (ratio[front] > 0).all() and not ratio[behind].any() and not bound[behind].any()

    # A bin has the largest ratio in it, which stands at its side that is nearer to the feed.
    side = np.minimum(np.abs(degrees[:-1]), np.abs(degrees[1:]))
    largest = np.cos(np.radians(side))
    assert (bound[front] >= largest[front] - 1e-6).all()

    # What the columns tell of that side is off by a cell at most, and the estimate allows for half a cell: so across the path the
    # estimate stands half a cell to either hand of the side. Where bins are narrower than a cell, which they are outside of `dense`,
    # they take over what a neighbour has.
    across = radius * np.sin(np.radians(side))
    width = radius * (np.sin(np.radians(side + 3)) - np.sin(np.radians(side)))
    at = lambda place: np.sqrt(np.clip(1 - (place / radius) ** 2, 0, 1))  # noqa: E731
    dense = front & (width > cell_mm)
    assert dense.sum() > 20
    assert (ratio[dense] <= at(np.clip(across - cell_mm / 2, 0, None))[dense] + 1e-3).all()
    assert (ratio[dense] >= at(across + cell_mm / 2)[dense] - 1e-3).all()


def test_a_setup_without_stock_says_what_is_missing(slot):
    with pytest.raises(clsmith.ClsmithError) as raised:
        clsmith.simulate(slot, {"tools": [{"match": {}, "diameter": 10}]})
    assert "stock" in raised.value.message and raised.value.help
    with pytest.raises(ValueError):
        clsmith.simulate(slot, {}, cell_mm=0)


def test_a_collision_is_a_finding(slot, shop):
    fast = slot.replace(b"GOTO/30", b"RAPID\nGOTO/30")
    run = clsmith.simulate(fast, shop, certified=False)
    assert run.faults[1] == 1
    assert "error" in [found.severity for found in run.findings]


def test_results_are_the_same_bytes_each_time(slot, shop):
    first, second = (clsmith.simulate(slot, shop).columns for _ in range(2))
    assert all(np.asarray(first[name]).tobytes() == np.asarray(second[name]).tobytes() for name in first)
