//! Texels in the smallest storage that loses nothing: bytes for 8-bit images, one channel for gray ones.

use std::sync::LazyLock;

use crate::geometry::{Rgb, luminance};

/// Values of the 256 codes of a byte.
type Decoding = [f32; 256];

static SRGB: LazyLock<Decoding> = LazyLock::new(|| {
    std::array::from_fn(|code| {
        let x = code as f64 / 255.0;
        // IEC 61966-2-1
        let linear = if x <= 0.04045 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) };
        linear as f32
    })
});

static LINEAR: LazyLock<Decoding> = LazyLock::new(|| std::array::from_fn(|code| code as f32 / 255.0));

/// One byte per channel, decoded by a table.
pub(crate) struct Coded<const CHANNELS: usize> {
    codes: Box<[[u8; CHANNELS]]>,
    decoding: &'static Decoding,
}

/// Single precision.
pub(crate) struct Plain<T>(Box<[T]>);

/// All texels of an image, in one of several storages.
pub(crate) enum Texels {
    CodedGray(Coded<1>),
    CodedColor(Coded<3>),
    PlainGray(Plain<f32>),
    PlainColor(Plain<[f32; 3]>),
}

/// Run the same expression for whichever storage it is.
macro_rules! with_texels {
    ($texels:expr, $name:ident => $body:expr) => {
        match $texels {
            crate::texture::texels::Texels::CodedGray($name) => $body,
            crate::texture::texels::Texels::CodedColor($name) => $body,
            crate::texture::texels::Texels::PlainGray($name) => $body,
            crate::texture::texels::Texels::PlainColor($name) => $body,
        }
    };
}
pub(crate) use with_texels;

impl Coded<1> {
    #[inline]
    pub(crate) fn number(&self, index: usize) -> f32 {
        self.decoding[usize::from(self.codes[index][0])]
    }

    #[inline]
    pub(crate) fn color(&self, index: usize) -> Rgb {
        Rgb::splat(self.number(index))
    }
}

impl Coded<3> {
    #[inline]
    pub(crate) fn color(&self, index: usize) -> Rgb {
        let [r, g, b] = self.codes[index];
        let decoding = self.decoding;
        Rgb::new(decoding[usize::from(r)], decoding[usize::from(g)], decoding[usize::from(b)])
    }

    #[inline]
    pub(crate) fn number(&self, index: usize) -> f32 {
        luminance(self.color(index))
    }
}

impl Plain<f32> {
    #[inline]
    pub(crate) fn number(&self, index: usize) -> f32 {
        self.0[index]
    }

    #[inline]
    pub(crate) fn color(&self, index: usize) -> Rgb {
        Rgb::splat(self.0[index])
    }
}

impl Plain<[f32; 3]> {
    #[inline]
    pub(crate) fn color(&self, index: usize) -> Rgb {
        Rgb::from_array(self.0[index])
    }

    #[inline]
    pub(crate) fn number(&self, index: usize) -> f32 {
        luminance(self.color(index))
    }
}

impl Texels {
    /// Choose the storage by trying the small ones first: a failing one usually fails at once.
    pub(crate) fn new(pixels: &[[f32; 3]]) -> Self {
        let gray = pixels.iter().all(|[r, g, b]| r == g && g == b);
        for decoding in [&*SRGB, &*LINEAR] {
            if gray {
                let codes = pixels.iter().map(|[value, ..]| Some([encode(*value, decoding)?])).collect();
                if let Some(codes) = codes {
                    return Self::CodedGray(Coded { codes, decoding });
                }
            } else {
                let code = |value: f32| encode(value, decoding);
                let codes = pixels.iter().map(|[r, g, b]| Some([code(*r)?, code(*g)?, code(*b)?])).collect();
                if let Some(codes) = codes {
                    return Self::CodedColor(Coded { codes, decoding });
                }
            }
        }
        if gray {
            Self::PlainGray(Plain(pixels.iter().map(|[value, ..]| *value).collect()))
        } else {
            Self::PlainColor(Plain(pixels.into()))
        }
    }

    /// Memory in bytes.
    pub(crate) fn bytes(&self) -> usize {
        match self {
            Self::CodedGray(texels) => size_of_val(&*texels.codes),
            Self::CodedColor(texels) => size_of_val(&*texels.codes),
            Self::PlainGray(texels) => size_of_val(&*texels.0),
            Self::PlainColor(texels) => size_of_val(&*texels.0),
        }
    }
}

/// The code of a value, if it has one up to rounding (codes are at least 3e-4 apart).
fn encode(value: f32, decoding: &Decoding) -> Option<u8> {
    let above = decoding.partition_point(|decoded| *decoded < value - 2e-6);
    let decoded = decoding.get(above)?;
    ((decoded - value).abs() <= 2e-6).then_some(above as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes_per_texel(pixels: &[[f32; 3]]) -> usize {
        let texels = Texels::new(pixels);
        for (index, pixel) in pixels.iter().enumerate() {
            let color = with_texels!(&texels, texels => texels.color(index));
            assert!((color - Rgb::from_array(*pixel)).abs().max_element() < 4e-6);
        }
        texels.bytes() / pixels.len()
    }

    #[test]
    fn storage_is_small_and_loses_nothing() {
        let gray: Vec<[f32; 3]> = SRGB.iter().map(|value| [*value; 3]).collect();
        let color: Vec<[f32; 3]> = (0..256).map(|i| [LINEAR[i], LINEAR[255 - i], LINEAR[7]]).collect();
        assert_eq!(bytes_per_texel(&gray), 1);
        assert_eq!(bytes_per_texel(&color), 3);
        assert_eq!(bytes_per_texel(&[[0.1234567; 3], [7.0; 3]]), 4);
        assert_eq!(bytes_per_texel(&[[0.1234567, 0.0, 0.0], [7.0; 3]]), 12);
    }
}
