//! The page on paper: A4, light colours, charts and a picture, and no word that is broken.

use super::{OpenedReport, open_report};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::json;

/// Words of the page that stand on more than one line; digests and text of files may be broken anywhere.
const BROKEN_WORDS: &str = "(() => {
  const walker = document.createTreeWalker(document.querySelector('main'), NodeFilter.SHOW_TEXT), broken = [], range = document.createRange();
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    if (node.parentElement.closest('pre, script, style, h1, svg, #basis table td:last-child')) continue;
    for (const word of node.data.matchAll(/[^\\s\\u2026\\/-]+/g)) {
      range.setStart(node, word.index);
      range.setEnd(node, word.index + word[0].length);
      const lines = new Set([...range.getClientRects()].map((box) => Math.round(box.top)));
      if (lines.size > 1) broken.push(word[0]);
    }
  }
  return broken;
})()";

#[test]
fn on_paper_charts_and_pictures_fit_and_no_word_is_broken() {
    let Some(OpenedReport { mut browser, .. }) = open_report() else { return };
    assert_eq!(browser.value(BROKEN_WORDS), json!([]), "on the screen");
    // Of a reader in the dark: paper is white all the same.
    let features = json!([{ "name": "prefers-color-scheme", "value": "dark" }]);
    browser.call("Emulation.setEmulatedMedia", json!({ "media": "print", "features": features }));
    let size = json!({ "width": 703, "height": 1030, "deviceScaleFactor": 1, "mobile": false });
    browser.call("Emulation.setDeviceMetricsOverride", size);
    browser.value("window.dispatchEvent(new Event('beforeprint'))");
    browser.wait("document.getElementById('picture')?.complete && document.getElementById('picture').naturalWidth > 100");
    assert_eq!(browser.text("getComputedStyle(document.body).backgroundColor"), "rgb(255, 255, 255)");
    assert_eq!(
        browser.text("getComputedStyle(document.documentElement).getPropertyValue('--ink').trim()"),
        "#14181f"
    );
    // A file deep in folders stands beside its digest, which breaks then.
    let deep = "document.querySelector('#basis tbody tr').cells[1].textContent = 'programs/customer/order-4711/op10/rough/part.cls'";
    assert!(browser.text(deep).ends_with("part.cls"));
    // A card that moves to the next page must not lie over the one behind it, as in the rows of a grid.
    assert_eq!(browser.text("getComputedStyle(document.querySelector('main')).display"), "block");
    // Charts are as wide as the paper, and nothing is wider.
    let widest = "Math.max(...[...document.querySelectorAll('main *')].filter((part) => !part.closest('pre, #picture')).map((part) => part.getBoundingClientRect().right))";
    let widest = browser.number(widest);
    assert!(widest <= 704.0, "{widest} pixels");
    assert!(browser.number("document.querySelector('svg.chart').getBoundingClientRect().width") > 600.0);
    assert_eq!(browser.value(BROKEN_WORDS), json!([]), "on paper");
    // What only a screen has is not printed.
    for hidden in ["#slider", "#view-bar", "#listing", "#chart-bar"] {
        let shown = format!("document.querySelector('{hidden}').getClientRects().length");
        assert_eq!(browser.number(&shown), 0.0, "{hidden}");
    }
    browser.value("window.dispatchEvent(new Event('afterprint'))");
    assert_eq!(browser.value("document.getElementById('picture') === null"), true);
    browser.call("Emulation.setEmulatedMedia", json!({ "media": "" }));
    let pdf = browser.call("Page.printToPDF", json!({ "preferCSSPageSize": true, "printBackground": true }));
    let pdf = STANDARD.decode(pdf["data"].as_str().unwrap()).unwrap();
    assert!(pdf.starts_with(b"%PDF") && pdf.len() > 30_000, "{} bytes", pdf.len());
    assert_eq!(browser.complaints(), [] as [String; 0]);
}
