//! The guard of the registries: a file of a family that its list forgets fails here.
//!
//! One algorithm is one file and one line in the list of its folder's `mod.rs`. A file that is declared but not listed would
//! never be found by name, one that is not even declared would never be compiled; neither is noticed otherwise.

use std::collections::BTreeSet;
use std::path::Path;

use evenlight_points::{blue_noise, scramble, sequences, warp};
use evenlight_render::{bsdf, emitter, filter, integrator, sampler, sensor, shape, texture};

/// A family: its folder below `crates`, the names in its registry, and the files that several of its members share.
type Family = (&'static str, Vec<&'static str>, &'static [&'static str]);

macro_rules! names {
    ($registry:expr) => {
        $registry.iter().map(|entry| entry.name).collect()
    };
}

fn families() -> Vec<Family> {
    vec![
        ("points/src/sequences", names!(sequences::ALL), &[]),
        ("points/src/scramble", names!(scramble::ALL), &["matrix"]),
        (
            "points/src/blue_noise",
            names!(blue_noise::ALL),
            // masks and pixels are no points
            &["decay", "pixel_order", "torus", "vector_mask", "void_and_cluster"],
        ),
        (
            "points/src/warp",
            names!(warp::ALL),
            &["curve", "options", "quantile", "real", "round", "rows", "steps", "triangle"],
        ),
        (
            "render/src/bsdf",
            names!(bsdf::ALL),
            &["coat", "fresnel", "gauss", "glass", "interface", "metal", "microfacet", "perturbed", "warp"],
        ),
        // `area` belongs to a shape and is built with it
        ("render/src/emitter", names!(emitter::ALL), &["area", "placement", "selection", "sky"]),
        ("render/src/filter", names!(filter::ALL), &[]),
        ("render/src/integrator", names!(integrator::ALL), &["roulette"]),
        ("render/src/sampler", names!(sampler::ALL), &[]),
        ("render/src/sensor", names!(sensor::ALL), &[]),
        ("render/src/shape", names!(shape::ALL), &["triangles"]),
        (
            "render/src/texture",
            names!(texture::ALL),
            // `constant` is what a plain color or number is read as
            &["constant", "coordinates", "exr", "image", "slot", "texels"],
        ),
    ]
}

/// The names of a family's files; `x.rs` and the folder `x` are both `x`.
fn files(folder: &str) -> BTreeSet<String> {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the folder of all crates");
    let entries = crates.join(folder).read_dir().expect(folder);
    let stem = |path: &Path| path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let stems: BTreeSet<_> = entries.flatten().filter_map(|entry| stem(&entry.path())).collect();
    stems.into_iter().filter(|name| name != "mod").collect()
}

#[test]
fn every_file_of_a_family_is_in_its_registry() {
    for (folder, names, shared) in families() {
        let known: BTreeSet<String> = names.iter().chain(shared).map(ToString::to_string).collect();
        assert_eq!(
            files(folder),
            known,
            "crates/{folder}: a file that is not in the registry of its mod.rs, or the reverse; \
             a file that several members share is named in this test"
        );
    }
}

#[test]
fn names_are_unique_and_fit_the_command_line() {
    for (folder, names, _) in families() {
        let unique: BTreeSet<_> = names.iter().collect();
        assert_eq!(unique.len(), names.len(), "{folder}");
        for name in names {
            assert!(name.bytes().all(|c| c.is_ascii_lowercase() || c == b'_'), "{folder}: '{name}'");
        }
    }
}
