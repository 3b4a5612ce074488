//! Any bytes as a profile of `clsmith section`: refused with a place, or a ball rolls over it and the way reads back.

#![no_main]

use clsmith::source::Source;
use clsmith::internals::surface::profile::{ChordSide, compensate_profile, fit_chords};
use clsmith::surface_milling::load_profile;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(source) = Source::new("profile.yaml", bytes.to_vec()) else { return };
    match load_profile(&source) {
        Ok(profile) => {
            let chain = profile.to_chain(0.01);
            let Ok(chain) = chain else { return };
            let tip = compensate_profile(&chain, 5.0).expect("a sensible ball");
            fit_chords(&tip, 0.01, true, ChordSide::Both).expect("a sensible tolerance");
        }
        Err(failure) => {
            let found = failure.findings();
            assert!(!found.is_empty(), "refused without a word");
            for label in found.iter().flat_map(|found| &found.labels) {
                assert!(label.span.end as usize <= bytes.len(), "a place outside the profile");
            }
        }
    }
});
