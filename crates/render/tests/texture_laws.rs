//! Laws of textures.

mod plugins;

use evenlight_render::geometry::{Rgb, Vec2};
use evenlight_render::texture::Texture;
use evenlight_render::texture::bitmap::{Bitmap, Filter, Wrap};

const COLORS: [[f32; 3]; 6] =
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.5, 0.2, 7.0], [0.1, 0.1, 0.1], [0.0, 0.3, 0.9]];

fn bitmap(filter: Filter, wrap: Wrap) -> Bitmap {
    Bitmap::new(3, &COLORS, filter, wrap)
}

#[test]
fn centers_of_texels_give_their_values() {
    for filter in [Filter::Bilinear, Filter::Nearest] {
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            let texture = bitmap(filter, wrap);
            for (index, color) in COLORS.iter().enumerate() {
                let uv = Vec2::new((index % 3) as f32 + 0.5, (index / 3) as f32 + 0.5) / Vec2::new(3.0, 2.0);
                let error = (texture.evaluate(uv) - Rgb::from_array(*color)).abs().max_element();
                assert!(error < 1e-5, "{filter:?} {wrap:?} {index}");
            }
        }
    }
}

#[test]
fn gradients_are_those_of_the_values() {
    for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
        let texture = bitmap(Filter::Bilinear, wrap);
        for i in 0..400 {
            let uv = Vec2::new((i % 20) as f32 * 0.141 - 0.93, (i / 20) as f32 * 0.137 - 0.77);
            let h = 1e-3;
            let difference = |step: Vec2| {
                (texture.evaluate_scalar(uv + step) - texture.evaluate_scalar(uv - step)) / (2.0 * h)
            };
            let expected = Vec2::new(difference(Vec2::new(h, 0.0)), difference(Vec2::new(0.0, h)));
            let error = (texture.gradient(uv) - expected).abs().max_element();
            assert!(error < 0.01, "{wrap:?} {uv}: {} but {expected}", texture.gradient(uv));
        }
    }
}

#[test]
fn any_coordinate_gives_a_finite_color() {
    let wild = [0.0, 1.0, -1.0, 0.999_999_94, -1e-9, 1e9, -1e9, f32::MIN, f32::MAX, f32::INFINITY, f32::NAN];
    for filter in [Filter::Bilinear, Filter::Nearest] {
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            let texture = bitmap(filter, wrap);
            for uv in wild.iter().flat_map(|x| wild.iter().map(|y| Vec2::new(*x, *y))) {
                let color = texture.evaluate(uv);
                assert!(!uv.is_finite() || color.is_finite(), "{filter:?} {wrap:?} {uv}: {color}");
            }
        }
    }
}

#[test]
fn storage_is_never_larger_than_three_floats() {
    assert_eq!(bitmap(Filter::Bilinear, Wrap::Repeat).bytes(), 6 * 12);
    let gray = vec![[128.0 / 255.0; 3]; 64];
    assert_eq!(Bitmap::new(8, &gray, Filter::Bilinear, Wrap::Repeat).bytes(), 64);
}

#[test]
fn means_are_means() {
    let expected = COLORS.iter().map(|color| Rgb::from_array(*color)).sum::<Rgb>() / 6.0;
    assert!((bitmap(Filter::Nearest, Wrap::Clamp).mean() - expected).abs().max_element() < 1e-6);
    let board = plugins::texture("<texture type=\"checkerboard\"/>").expect("a checkerboard");
    assert!((board.mean() - Rgb::splat(0.3)).abs().max_element() < 1e-6);
}
