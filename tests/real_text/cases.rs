//! The programs of `../shared/cases`, whose right values stand in `CASES.md` there.

use super::{alarms, assert_near, read, totals};
use crate::support::require_shared_folder;

/// A case: its file, and its length at feed, its length at rapid and its time at feed; a NaN is not asked.
type Case = (&'static str, f64, f64, f64);

/// The cases that a check finds nothing in.
const CLEAN: &[Case] = &[
    ("01-number-split.aptsource", 1711.0, 1580.465, 68.44),
    ("02-list-split.aptsource", 118.5, 99.5, 11.109),
    ("03-pprint-continued.aptsource", 139.0, 27.0, 17.375),
    ("16-columns-catia.aptsource", 127.208, 112.35, 13.629),
    ("17-columns-classic.apt", 70.0, 30.0, 10.0),
    ("18-gohome-empty.apt", 91.0, 28.0, 15.6),
    ("19-stop-text.aptsource", 242.0, 84.0, 24.2),
    ("20-opstop-text.apt", 76.5, 16.5, 10.929),
    ("21-movarc-extra.apt", 24.566, f64::NAN, 4.211),
    ("04-tap-feeds.cls", f64::NAN, f64::NAN, f64::NAN),
    ("06-thread.cls", 96.0, f64::NAN, 17.554),
    ("07-helical-up.aptsource", 168.807, 21.0, 28.938),
    ("08-cylinder-arc-yz.aptsource", 75.525, f64::NAN, 10.07),
    ("09-creo-arc-points.ncl", 65.36, f64::NAN, 16.34),
    ("10-creo-cusp-clockwise.ncl", 37.425, f64::NAN, 10.207),
    ("23-local-origin.aptsource", f64::NAN, f64::NAN, f64::NAN),
    ("24-two-channels.aptsource", 68.828, 203.77, 22.999),
    ("27-movarc-angle.apt", 72.265, f64::NAN, 9.635),
    ("28-clt-g98.clt", 42.0, 320.0, 16.8),
    ("28-clt-g99.clt", 42.0, 168.0, 16.8),
    ("29-cycle-clear.apt", 24.0, 168.0, 6.0),
    ("30-tool-change-point.cls", 142.0, 244.0, f64::NAN),
    ("31-tap-no-feed.aptsource", 78.0, f64::NAN, f64::NAN),
    ("25-conical-mill.aptsource", 54.0, f64::NAN, 12.96),
    ("26-engraver.cls", 59.5, f64::NAN, 11.9),
    ("32-turning-surface-speed.aptsource", 64.0, f64::NAN, 14.278),
    ("33-numbered.cls", 140.708, f64::NAN, 14.731),
    ("34-comma-names.cls", 84.5, f64::NAN, f64::NAN),
];

/// The cases with findings: their codes and lines.
const WITH_FINDINGS: &[(Case, &[(&str, usize)])] = &[
    (("11-stray-equals.aptsource", 148.0, f64::NAN, 11.471), &[("CL0001", 28)]),
    (("12-stray-lines.ncl", 145.0, f64::NAN, 24.167), &[("CL0001", 19), ("CL0001", 21)]),
    (("37-unknown-points.apt", 77.208, f64::NAN, f64::NAN), &[("CL0159", 10), ("CL0159", 14)]),
    (("42-opposite-senses.cls", 197.265, f64::NAN, f64::NAN), &[("CL0119", 32)]),
    (("35-gcode.nc", 0.0, 0.0, 0.0), &[("CL0012", 1)]),
    (("35-gcode-bare.nc", 0.0, 0.0, 0.0), &[("CL0012", 1)]),
    (("36-heidenhain.h", 0.0, 0.0, 0.0), &[("CL0012", 1)]),
];

#[test]
fn cases_have_their_lengths_times_and_findings() {
    let Some(folder) = require_shared_folder("cases") else { return };
    let clean = CLEAN.iter().map(|case| (*case, &[] as &[_]));
    for ((name, feed, rapid, seconds), expected) in clean.chain(WITH_FINDINGS.iter().copied()) {
        let text = std::fs::read(folder.join(name)).unwrap();
        let found = alarms(&text);
        let found: Vec<_> = found.iter().map(|(code, line)| (code.as_str(), *line)).collect();
        assert_eq!(found, expected, "{name}");
        let lengths = totals(&read(&text));
        for (what, found, wanted) in
            [("feed", lengths.0, feed), ("rapid", lengths.1, rapid), ("seconds", lengths.2, seconds)]
        {
            if !wanted.is_nan() {
                assert_near(&format!("{name}: {what}"), found, wanted);
            }
        }
    }
}
