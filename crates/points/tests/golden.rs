//! Golden bits: the numbers of a seed are part of the interface and must not change unnoticed.
//!
//! After a deliberate change, `EVENLIGHT_BLESS=1 cargo test -p evenlight-points --test golden` writes
//! the file anew; say so in the change log.

mod examples;

use std::fmt::Write;
use std::path::Path;

use evenlight_points::Seed;
use examples::{build, pairs};

#[test]
fn bits_are_those_of_the_golden_file() {
    let mut text = String::new();
    for (entry, randomization) in pairs() {
        let points = build(entry, 40, randomization, Seed::new(7));
        for index in [0, 1, 2, 1000, (1 << 33) + 7, u64::MAX]
            .map(|index| points.len().map_or(index, |len| index % len))
        {
            write!(text, "{} {} {index}", entry.name, randomization.name()).expect("writing to a string");
            for dim in [0, 1, 5, 39].into_iter().filter(|&dim| dim < points.dims()) {
                let bits = points.coord(index, dim).to_bits();
                write!(text, " {bits:016x}").expect("writing to a string");
            }
            text.push('\n');
        }
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden.txt");
    if std::env::var_os("EVENLIGHT_BLESS").is_some() {
        std::fs::write(&path, &text).expect("the golden file is writable");
    }
    let golden = std::fs::read_to_string(&path).expect("the golden file is readable");
    for (line, (now, then)) in text.lines().zip(golden.lines()).enumerate() {
        assert_eq!(now, then, "line {} of {}", line + 1, path.display());
    }
    assert_eq!(text.lines().count(), golden.lines().count());
}
