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
    ratio = engaged.advance_ratio[-1]
    degrees = -180 + 3 * np.arange(120) + 1.5
    # In a slot the wall advances as the cosine of the direction, in front alone; the estimate allows for half a cell.
    front = np.abs(degrees) < 80
    assert np.allclose(ratio[front], np.cos(np.radians(degrees[front])), atol=0.16)
    assert not ratio[np.abs(degrees) > 100].any()
    assert (engaged.advance_ratio_bound[-1] >= ratio - 1e-6).all()
    assert np.nanmax(engaged.high_mm[-1]) > np.nanmin(engaged.low_mm[-1])


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
