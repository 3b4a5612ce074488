//! Names in any encoding, and shards.

use clsmith::batch::{PortablePath, Shard};
use proptest::prelude::*;
use std::path::Path;

#[test]
fn a_name_is_text_where_it_can_be() {
    let json = |name: &PortablePath| serde_json::to_string(name).unwrap();
    assert_eq!(json(&PortablePath::from_path(Path::new("a b/ü\n.cls"))), r#""a b/ü\n.cls""#);
    assert_eq!(PortablePath::from_path(Path::new("a\u{1b}[2J\n.cls")).to_string(), "a?[2J?.cls");
    for bad in [r#"{"lossy":"x","hex":"0"}"#, r#"{"lossy":"x","hex":"zz"}"#, r#"{"hex":"00"}"#, "1"] {
        assert!(serde_json::from_str::<PortablePath>(bad).is_err(), "{bad}");
    }
}

#[cfg(unix)]
#[test]
fn no_byte_of_a_name_is_lost() {
    use std::os::unix::ffi::OsStrExt;
    let name = PortablePath::from_path(Path::new(std::ffi::OsStr::from_bytes(b"part\xff\n.cls")));
    let json = serde_json::to_string(&name).unwrap();
    assert_eq!(json, "{\"lossy\":\"part\u{fffd}\\n.cls\",\"hex\":\"70617274ff0a2e636c73\"}");
    assert_eq!(serde_json::from_str::<PortablePath>(&json).unwrap(), name);
}

#[test]
fn shards_are_read() {
    let shard = |text: &str| text.parse::<Shard>();
    assert_eq!(shard("2/8").unwrap(), Shard::new(2, 8).unwrap());
    assert_eq!(shard("2/8").unwrap().to_string(), "2/8");
    assert_eq!(shard("2/8").unwrap().file_name_part(), "2-of-8");
    assert!(shard("0/8").unwrap_err().to_string().contains("add 1"));
    for bad in ["9/8", "1/0", "0/0", "2", "a/b", "-1/8", "1/2/3", "/"] {
        assert!(shard(bad).is_err(), "{bad}");
    }
}

proptest! {
    #![proptest_config(crate::support::property(256))]

    #[cfg(unix)]
    #[test]
    fn every_name_comes_back(bytes in proptest::collection::vec(1u8.., 1..20)) {
        use std::os::unix::ffi::OsStrExt;
        let name = PortablePath::from_path(Path::new(std::ffi::OsStr::from_bytes(&bytes)));
        let json = serde_json::to_string(&name).unwrap();
        prop_assert!(!json.contains('\n'));
        prop_assert_eq!(serde_json::from_str::<PortablePath>(&json).unwrap(), name);
    }

    #[test]
    fn shards_share_everything_evenly(count in 1u32..50, files in 0usize..500) {
        let shards: Vec<Shard> = (1..=count).map(|index| Shard::new(index, count).unwrap()).collect();
        let mut sizes = vec![0usize; shards.len()];
        for file in 0..files {
            let whose: Vec<usize> = (0..shards.len()).filter(|&index| shards[index].contains(file)).collect();
            prop_assert_eq!(whose.len(), 1);
            sizes[whose[0]] += 1;
        }
        let most = sizes.iter().max().unwrap();
        prop_assert!(sizes.iter().all(|size| most - size <= 1));
    }
}
