//! `examples/points.c`, compiled with the header and linked with the library, against the same words from Rust.

use std::path::{Path, PathBuf};
use std::process::Command;

use evenlight_points::convert::unit_f32;
use evenlight_points::stateless::{SOBOL_DIMS, owen_sobol, shuffled, sobol};

const SEED: u64 = 0x0123_4567_89ab_cdef;

/// The static library that cargo built together with this test.
fn library() -> PathBuf {
    let test = std::env::current_exe().expect("a test is a file");
    let folder = test.parent().expect("a file is in a folder");
    let mut found: Vec<_> = std::fs::read_dir(folder)
        .expect("readable")
        .map(|entry| entry.expect("readable").path())
        .filter(|path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            name.starts_with("libevenlight_points_c") && path.extension().is_some_and(|end| end == "a")
        })
        .collect();
    found.sort_by_key(|path| path.metadata().and_then(|data| data.modified()).expect("a date"));
    found.pop().expect("cargo builds the library before its tests")
}

/// Compiles the example, all warnings being errors, and says what it prints.
fn run_example() -> String {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    let compiler = std::env::var("CC").unwrap_or_else(|_| "cc".into());
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("points");
    let compiled = Command::new(&compiler)
        .args(["-std=c99", "-O1", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-I"])
        .arg(here.join("include"))
        .arg(here.join("examples/points.c"))
        .arg(library())
        .args(["-lpthread", "-ldl", "-lm", "-o"])
        .arg(&program)
        .output()
        .unwrap_or_else(|error| {
            panic!("this test needs the C compiler {compiler} (set CC to choose another): {error}")
        });
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    let done = Command::new(program).output().expect("the program was just linked");
    assert!(done.status.success(), "a dimension beyond the table does not give 0");
    String::from_utf8(done.stdout).expect("ASCII")
}

#[test]
#[cfg(unix)]
fn the_c_program_prints_the_words_of_rust() {
    let printed = run_example();
    let mut lines = printed.lines();
    for index in 0..8 {
        for dimension in (0..SOBOL_DIMS).step_by(51) {
            let words = [sobol(index, dimension), owen_sobol(index, dimension, SEED), shuffled(index, SEED)];
            let line = lines.next().expect("as many lines as words");
            let (numbers, unit) = line.rsplit_once(' ').expect("columns");
            let [plain, scrambled, order] = words;
            assert_eq!(numbers, format!("{index} {dimension} {plain} {scrambled} {order}"));
            assert_eq!(unit.parse(), Ok(unit_f32(scrambled)));
        }
    }
    // The standard error of Owen-scrambled points is below 1e-5 here; a word in the wrong place would cost 1e-4.
    let mean = lines.next().and_then(|line| line.split([' ', ',']).nth(4)?.parse::<f64>().ok());
    assert!((mean.expect("a mean") - 0.25).abs() < 5e-5, "{mean:?}");
}

#[test]
fn the_header_knows_the_number_of_dimensions() {
    let header = include_str!("../include/evenlight_points.h");
    assert!(header.contains(&format!("#define EVENLIGHT_SOBOL_DIMS {SOBOL_DIMS}\n")));
}
