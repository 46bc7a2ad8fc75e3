//! What bounces contribute: exactly in a room of mirrors, the same bits on any number of threads, and limits.

mod stage;

use evenlight_render::bounces::{Bounces, measure};
use evenlight_render::render::Settings;
use evenlight_render::scene::Scene;
use stage::scene;

/// A room whose walls emit `(4, 4, 4)` and reflect half of the light like mirrors: nothing in it is random.
fn mirrors() -> Scene {
    scene(
        "<sensor type='perspective'><float name='fov' value='60'/><transform name='to_world'>\
         <lookat origin='0.2 0.1 0.3' target='-0.1 -0.2 -1' up='0 1 0'/></transform><film type='hdrfilm'>\
         <integer name='width' value='20'/><integer name='height' value='17'/><rfilter type='box'/></film></sensor>\
         <shape type='sphere'><boolean name='flip_normals' value='true'/><bsdf type='conductor'>\
         <string name='material' value='none'/><rgb name='specular_reflectance' value='0.5'/></bsdf>\
         <emitter type='area'><rgb name='radiance' value='4'/></emitter></shape>",
    )
}

fn bounces(scene: &Scene, settings: &Settings, images: bool) -> Bounces {
    measure(scene, settings, images, &mut |_| true).expect("valid settings").expect("not stopped")
}

#[test]
fn mirrors_make_a_geometric_series() {
    let settings = Settings { spp: 3, max_depth: Some(9), ..Settings::default() };
    let found = bounces(&mirrors(), &settings, true);
    assert_eq!(found.size, [20, 17]);
    for l in 0..9 {
        let contribution = 4.0 * 0.5_f64.powi(l as i32);
        let tail = 2.0 * contribution - 8.0 * 0.5_f64.powi(9);
        let near = |x: f64, exact: f64| assert!((x - exact).abs() < 1e-5 * exact, "{l}: {x} for {exact}");
        near(found.mean[l], contribution);
        near(found.mean_square[l], contribution * contribution);
        near(found.tail_mean_square[l], tail * tail);
        assert_eq!([found.alive[l], found.rays[l]], [1.0, 1.0]);
        let image = &found.images[l * 20 * 17..(l + 1) * 20 * 17];
        image.iter().flatten().for_each(|&x| near(x.into(), contribution));
    }
}

#[test]
fn threads_change_no_bit() {
    let diffuse = scene(
        "<shape type='cube'><boolean name='flip_normals' value='true'/></shape><shape type='rectangle'><transform \
         name='to_world'><scale value='0.3'/><rotate x='1' angle='90'/><translate y='0.95'/></transform>\
         <emitter type='area'><rgb name='radiance' value='4 3 2'/></emitter></shape>\
         <sensor type='perspective'><film type='hdrfilm'><integer name='width' value='50'/>\
         <integer name='height' value='33'/></film></sensor>",
    );
    let settings = |threads| Settings { spp: 2, max_depth: Some(5), threads, ..Settings::default() };
    let bits = |found: &Bounces| {
        let numbers = [&found.mean, &found.mean_square, &found.tail_mean_square, &found.alive, &found.rays];
        numbers.into_iter().flatten().map(|x| x.to_bits()).collect::<Vec<_>>()
    };
    let one = bounces(&diffuse, &settings(1), true);
    assert!(one.mean.iter().skip(1).take(3).all(|mean| *mean > 0.0));
    for threads in [0, 2, 7] {
        let other = bounces(&diffuse, &settings(threads), true);
        assert!(bits(&one) == bits(&other) && one.images == other.images, "{threads}");
    }
}

#[test]
fn no_limit_and_too_large_images_are_refused() {
    let refusal = |settings: Settings| {
        measure(&mirrors(), &settings, true, &mut |_| true).expect_err("must be refused").to_string()
    };
    for max_depth in [None, Some(0), Some(1025), Some(u32::MAX)] {
        let message = refusal(Settings { max_depth, ..Settings::default() });
        assert!(message.contains("max_depth must be 1 to 1024"), "{message}");
    }
    let huge = Settings { max_depth: Some(1000), size: Some([1000, 1000]), ..Settings::default() };
    assert!(refusal(huge).contains("too large"));
    let stopped = measure(
        &mirrors(),
        &Settings { spp: 1 << 16, max_depth: Some(1000), ..Settings::default() },
        false,
        &mut |_| false,
    );
    assert!(stopped.expect("valid settings").is_none());
}
