//! What a reader sees of figures: before and after over each other, limits, histogram, worst places, bars and tools.

use super::{OpenedReport, choose, open_report};

#[test]
fn before_and_after_are_both_seen_and_limits_are_lines() {
    let Some(OpenedReport { mut browser, .. }) = open_report() else { return };
    // The band of after is filled and let through, before is drawn over it as a thinner line that fills nothing.
    let order = "[...document.querySelectorAll('svg.chart')].every((chart) => {
      const parts = [...chart.children], at = (name) => parts.findIndex((part) => part.matches(name));
      const style = (name) => getComputedStyle(chart.querySelector(name));
      return at('.band.after') < at('.line.after') && at('.line.after') < at('.line.before')
        && style('.line.before').fill === 'none' && style('.band.after').fill.startsWith('rgba')
        && parseFloat(style('.line.before').strokeWidth) < parseFloat(style('.line.after').strokeWidth);
    })";
    assert_eq!(browser.value(order), true);
    // Each axis has a title with its unit; the legend has the style of what is drawn.
    let titles = browser
        .value("[...document.querySelectorAll('svg.chart text.title')].map((title) => title.textContent)");
    assert_eq!(
        titles,
        serde_json::json!(["feed, mm/min", "thickest chip, mm", "largest power, kW", "z, mm"])
    );
    assert_eq!(
        browser.value("['line.before', 'line.after', 'band.after'].every((name) => document.querySelector(`.key .${name}`))"),
        true
    );
    // The target of the recipe stands where the axis has it.
    let off = browser.number(
        "(() => { const chart = clsmith.charts.list.find((chart) => chart.quantity === 'chip');
          const at = Number(chart.element.querySelector('path.limit').getAttribute('d').split(' ')[1].split('H')[0]);
          return Math.abs(at - chart.y(0.04)); })()",
    );
    assert!(off < 0.06, "{off} pixels");
    let labels = "[...document.querySelectorAll('svg.chart, svg.strip, svg.histogram, #view canvas, #legend canvas')].every((drawing) =>
      drawing.getAttribute('role') === 'img' && drawing.getAttribute('aria-label').length > 10)";
    assert_eq!(browser.value(labels), true);
    assert!(
        browser
            .text("document.querySelector('svg.chart').getAttribute('aria-label')")
            .contains("before: 800 mm/min to 800 mm/min")
    );
}

#[test]
fn loads_by_time_the_worst_places_and_bars_say_what_the_arrays_say() {
    let Some(OpenedReport { mut browser, .. }) = open_report() else { return };
    // The histogram has a target, and fills bins with all the time in material.
    assert_eq!(browser.number("document.querySelectorAll('svg.histogram path.limit').length"), 1.0);
    assert!(browser.number("document.querySelectorAll('svg.histogram rect.after').length") >= 1.0);
    assert!(browser.number("document.querySelectorAll('svg.histogram rect.before').length") >= 1.0);
    // The worst place is the largest value, and its link goes there.
    browser.value("document.querySelector('#worst a').click()");
    let largest = "(() => { const chips = clsmith.shown.chip; return chips[clsmith.motion] === Math.max(...[...chips].filter((chip) => chip === chip)); })()";
    assert_eq!(browser.value(largest), true);
    assert!(browser.text("document.querySelector('#worst').textContent").contains("of its target"));
    choose(&mut browser, "load", "power");
    assert!(browser.text("document.querySelector('#worst thead').textContent").contains("largest power, kW"));
    // The printed peak is one figure wherever it stands.
    let peak = browser.text("document.querySelector('#worst tbody td:nth-child(3)').textContent");
    assert!(browser.text("document.getElementById('figures').textContent").contains(&peak), "{peak}");
    // Tools have a picture, operations two bars.
    assert_eq!(browser.number("document.querySelectorAll('table.tools svg.tool path.flutes').length"), 1.0);
    assert!(
        browser
            .text("document.querySelector('table.tools').textContent")
            .contains("diameter 10 mm, flutes 20 mm long, 4 teeth")
    );
    assert_eq!(browser.number("document.querySelectorAll('table.bars tbody rect').length"), 2.0);
    assert!(browser.text("document.body.textContent").contains("block from (0, 0, -10) to (60, 40, 0)"));
    assert_eq!(browser.complaints(), [] as [String; 0]);
}
