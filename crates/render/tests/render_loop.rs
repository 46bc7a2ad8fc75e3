//! The render loop: the same bits however the work is cut, honest partial films, and settings that are checked.

mod stage;

use evenlight_render::film::Film;
use evenlight_render::render::{Settings, render};
use evenlight_render::scene::Scene;
use stage::{picture, scene, try_picture};

/// A room with a lamp, seen through a film of this size and more.
fn room(film: &str) -> Scene {
    scene(&format!(
        "<sensor type='perspective'><float name='fov' value='60'/><transform name='to_world'>\
         <lookat origin='0.2 0.1 0.9' target='-0.1 -0.2 -1' up='0 1 0'/></transform>\
         <film type='hdrfilm'>{film}<rfilter type='gaussian'/></film></sensor>\
         <shape type='cube'><boolean name='flip_normals' value='true'/></shape>\
         <shape type='sphere'><float name='radius' value='0.3'/><point name='center' x='-0.3' y='0' z='-0.4'/></shape>\
         <shape type='rectangle'><transform name='to_world'><scale value='0.3'/><rotate x='1' angle='90'/>\
         <translate y='0.95'/></transform><emitter type='area'><rgb name='radiance' value='4 3 2'/></emitter></shape>"
    ))
}

fn size(width: u32, height: u32) -> String {
    format!("<integer name='width' value='{width}'/><integer name='height' value='{height}'/>")
}

fn settings() -> Settings {
    Settings { spp: 6, replicates: 3, threads: 1, max_depth: Some(4), ..Settings::default() }
}

fn bits(colors: &[[f32; 3]]) -> Vec<u32> {
    colors.iter().flatten().map(|x| x.to_bits()).collect()
}

fn all_bits(film: &Film) -> Vec<u32> {
    let mut all = bits(&film.colors);
    all.extend(bits(&film.albedo));
    all.extend(bits(&film.normal));
    all.extend(film.depth.iter().map(|x| x.to_bits()));
    all
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    // no multiple of a tile
    let scene = room(&size(37, 21));
    for sampler in ["independent", "sobol", "halton", "zsobol"] {
        let base = Settings { sampler: sampler.into(), ..settings() };
        let one = all_bits(&picture(&scene, &base));
        for threads in [0, 2, 5, 64] {
            assert!(one == all_bits(&picture(&scene, &Settings { threads, ..base.clone() })), "{threads}");
        }
    }
}

#[test]
fn a_crop_window_shows_the_pixels_of_the_whole_film() {
    let whole = picture(&room(&size(40, 30)), &settings());
    let (left, top, width, height) = (11, 5, 20, 18);
    let crop = format!(
        "{}<integer name='crop_offset_x' value='{left}'/><integer name='crop_offset_y' value='{top}'/>\
         <integer name='crop_width' value='{width}'/><integer name='crop_height' value='{height}'/>",
        size(40, 30)
    );
    let part = picture(&room(&crop), &settings());
    assert_eq!((part.width, part.height), (width as u32, height as u32));
    for (number, color) in part.colors.iter().enumerate() {
        let (replicate, y, x) = (number / (width * height), number / width % height, number % width);
        let same = whole.colors[(replicate * 30 + top + y) * 40 + left + x];
        assert_eq!(bits(&[*color]), bits(&[same]), "replicate {replicate}, ({x}, {y})");
    }
}

#[test]
fn a_canceled_render_keeps_whole_replicates_of_each_tile() {
    // Many tiles, each far shorter than the time between two questions.
    let scene = room(&size(64, 64));
    let of = |replicates| Settings { spp: 16 * replicates, replicates, threads: 2, ..settings() };
    let mut questions = 0;
    let film = render(&scene, &of(60), &mut |progress| {
        questions += 1;
        assert!(progress.samples <= progress.total);
        progress.samples < 64 * 64 * 16
    });
    let film = film.expect("valid settings");
    let fewest = film.completed.iter().min().copied().unwrap_or_default();
    let most = film.completed.iter().max().copied().unwrap_or_default();
    assert!(fewest < 60, "it went on to the end, asked {questions} times");
    assert!(most > 0 && most - fewest <= 1, "{fewest} to {most} replicates");

    let whole = picture(&scene, &of(most));
    let pixels = 64 * 64;
    for (number, color) in film.colors.iter().enumerate() {
        let (replicate, pixel) = (number / pixels, number % pixels);
        if replicate < film.completed[pixel] as usize {
            assert_eq!(bits(&[*color]), bits(&[whole.colors[number]]), "{replicate}, {pixel}");
        } else {
            assert!(color.iter().all(|x| x.is_nan()), "{replicate}, {pixel}: {color:?}");
        }
    }
}

#[test]
fn progress_is_reported_to_the_end() {
    let mut last = None;
    let film = render(&room(&size(20, 20)), &settings(), &mut |progress| {
        last = Some((progress.samples, progress.total));
        true
    });
    assert!(film.expect("valid settings").completed.iter().all(|&count| count == 3));
    assert_eq!(last, Some((20 * 20 * 6, 20 * 20 * 6)));
}

#[test]
fn seeds_and_replicates_differ() {
    let scene = room(&size(16, 16));
    let first = picture(&scene, &settings());
    let second = picture(&scene, &Settings { seed: 1, ..settings() });
    let replicates: Vec<_> =
        [&first, &second].into_iter().flat_map(|film| film.colors.chunks_exact(16 * 16)).collect();
    for (a, b) in (0..replicates.len()).flat_map(|a| (0..a).map(move |b| (a, b))) {
        let same = replicates[a].iter().zip(replicates[b]).filter(|(a, b)| a == b && a[0] != 0.0).count();
        assert!(same < 5, "{same} pixels of {a} and {b} agree");
    }
    // the first replicates do not depend on how many there are
    let fewer = picture(&scene, &Settings { spp: 4, replicates: 2, ..settings() });
    assert_eq!(bits(&fewer.colors), bits(&first.colors[..2 * 16 * 16]));
}

#[test]
fn settings_are_checked() {
    let scene = room(&size(8, 8));
    let refused = |settings: Settings, parts: &[&str]| {
        let error = try_picture(&scene, &settings).map(|_| ()).expect_err(parts[0]).to_string();
        assert!(parts.iter().all(|part| error.contains(part)), "'{error}' does not say {parts:?}");
    };
    refused(Settings { spp: 7, ..settings() }, &["spp (7)", "multiple of replicates (3)"]);
    refused(Settings { spp: 0, ..settings() }, &["at least 1"]);
    refused(Settings { replicates: 0, ..settings() }, &["at least 1"]);
    for size in [[0, 8], [8, 0], [40_000, 8]] {
        refused(Settings { size: Some(size), ..settings() }, &["size", "1 to 32768 pixels"]);
    }
    let name = || "x".to_owned();
    refused(
        Settings { sampler: name(), ..settings() },
        &["unknown sampler 'x'", "independent, sobol, halton"],
    );
    refused(Settings { integrator: name(), ..settings() }, &["unknown integrator 'x'", "path"]);
    refused(
        Settings { filter: Some(name()), ..settings() },
        &["unknown filter 'x'", "box, catmullrom, gaussian"],
    );
}

#[test]
fn another_size_renders_the_whole_film() {
    let crop = format!("{}<integer name='crop_width' value='3'/>", size(8, 8));
    let film = picture(&room(&crop), &Settings { size: Some([10, 4]), ..settings() });
    assert_eq!((film.width, film.height, film.completed.len()), (10, 4, 40));
}

/// A floor of albedo 0.5 that glows with radiance 1 under a sky of radiance 2, seen from above.
fn glowing_floor(integrator: &str) -> Scene {
    scene(&format!(
        "{integrator}<sensor type='orthographic'><transform name='to_world'>\
         <lookat origin='0 0 1' target='0 0 0' up='0 1 0'/></transform><film type='hdrfilm'>{}</film></sensor>\
         <shape type='rectangle'><transform name='to_world'><scale value='9'/></transform>\
         <bsdf type='diffuse'/><emitter type='area'/></shape>\
         <emitter type='constant'><rgb name='radiance' value='2'/></emitter>",
        size(4, 4)
    ))
}

fn mean(film: &Film) -> f32 {
    film.colors.iter().map(|color| color[1]).sum::<f32>() / film.colors.len() as f32
}

#[test]
fn depth_counts_edges() {
    let path = |depth: i32, more: &str| {
        format!("<integrator type='path'><integer name='max_depth' value='{depth}'/>{more}</integrator>")
    };
    let base = Settings { spp: 768, filter: Some("box".into()), max_depth: None, ..settings() };
    let hidden = "<boolean name='hide_emitters' value='true'/>";
    for (integrator, override_depth, exact) in [
        (path(1, ""), None, 1.0),
        (path(2, ""), None, 2.0),
        (path(-1, ""), None, 2.0),
        (path(-1, ""), Some(1), 1.0),
        (path(1, ""), Some(2), 2.0),
        (path(1, hidden), None, 0.0),
        ("<integrator type='direct'/>".to_owned(), None, 2.0),
        (String::new(), None, 2.0),
    ] {
        let film =
            picture(&glowing_floor(&integrator), &Settings { max_depth: override_depth, ..base.clone() });
        let ours = mean(&film);
        assert!((ours - exact).abs() < 0.02, "{integrator} {override_depth:?}: {ours}, not {exact}");
    }
}
