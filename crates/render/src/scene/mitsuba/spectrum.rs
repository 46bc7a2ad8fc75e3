//! `<spectrum>` as a linear sRGB color.

use super::document::Element;
use super::values::{float, shorten};
use crate::Result;
use crate::scene::folder::{self, Folder};
use crate::scene::node::{Kind, Parameter, Value};
use crate::scene::spectrum::{self, Role};

/// The largest table, in bytes.
const TABLE_LIMIT: u64 = 16 << 20;

/// What a spectrum of this name means to a plugin of this kind. Coefficients of media are unbounded; Mitsuba 3.9.1 clamps
/// tabulated ones to 1 as if they were reflectances.
pub(super) fn role(kind: Kind, name: &str) -> Role {
    match (kind, name) {
        (Kind::Emitter, _) => Role::Emission,
        (_, "eta" | "k" | "int_ior" | "ext_ior" | "sigma_t" | "sigma_a" | "sigma_s") => Role::Unbounded,
        _ => Role::Reflectance,
    }
}

/// `value="…"` (a number, or `wavelength:value` pairs) or `filename="….spd"`.
pub(super) fn read(element: &Element<'_>, folder: &Folder, role: Role) -> Result<[f64; 3]> {
    let blame = |message: String| element.error(message);
    let pairs = match (element.get("value"), element.get("filename")) {
        (Some(text), None) if !text.contains(':') => {
            return float(text).map(|value| spectrum::uniform(value, role)).map_err(blame);
        }
        (Some(text), None) => written(text).map_err(blame)?,
        (None, Some(name)) => {
            let path = folder.resolve(name).map_err(blame)?;
            let bytes = folder::read(&path, TABLE_LIMIT)?;
            let text = String::from_utf8_lossy(&bytes);
            table(&text).map_err(|message| element.error(format_args!("{}: {message}", path.display())))?
        }
        _ => return Err(element.error("needs either 'value' or 'filename'")),
    };
    if pairs.len() < 2 {
        return Err(element.error("a tabulated spectrum needs at least two wavelengths"));
    }
    if let Some(pair) = pairs.windows(2).find(|pair| pair[0].0 >= pair[1].0) {
        return Err(
            element.error(format_args!("wavelengths must increase, but {} follows {}", pair[1].0, pair[0].0))
        );
    }
    let (wavelengths, values): (Vec<f64>, Vec<f64>) = pairs.into_iter().unzip();
    Ok(spectrum::tabulated(&wavelengths, &values, role))
}

fn written(text: &str) -> std::result::Result<Vec<(f64, f64)>, String> {
    let separator = |c: char| c.is_ascii_whitespace() || c == ',';
    let pair = |word: &str| match word.split_once(':') {
        Some((wavelength, value)) => Ok((float(wavelength)?, float(value)?)),
        None => Err(format!("'{}' is not of the form wavelength:value", shorten(word))),
    };
    text.split(separator).filter(|word| !word.is_empty()).map(pair).collect()
}

/// Lines of a wavelength in nm and a value; `#` starts a comment.
fn table(text: &str) -> std::result::Result<Vec<(f64, f64)>, String> {
    let lines = text.lines().map(|line| line.split('#').next().unwrap_or_default().trim());
    let pair = |line: &str| match line.split_ascii_whitespace().collect::<Vec<_>>()[..] {
        [wavelength, value] => Ok((float(wavelength)?, float(value)?)),
        _ => Err(format!("'{}' is not a wavelength and a value", shorten(line))),
    };
    lines.filter(|line| !line.is_empty()).map(pair).collect()
}

/// `<spectrum type="…">`: the plugins that have a color in Mitsuba's RGB variants.
pub(super) fn plugin(plugin: &str, parameters: &[Parameter]) -> std::result::Result<[f64; 3], String> {
    let allowed: &[&str] = match plugin {
        "uniform" => &["value"],
        "d65" => &["scale", "color"],
        "srgb" => &["color"],
        _ => {
            let known =
                "known: d65, srgb, uniform; others have no color in an RGB renderer, give <rgb> instead";
            return Err(format!("unknown spectrum '{}'; {known}", shorten(plugin)));
        }
    };
    let mut color = [1.0; 3];
    for Parameter { name, value, .. } in parameters {
        if !allowed.contains(&&name[..]) {
            return Err(format!("unknown parameter '{name}'; known: {}", allowed.join(", ")));
        }
        let factor = match *value {
            Value::Float(x) => [x; 3],
            Value::Integer(x) => [x as f64; 3],
            Value::Rgb(rgb) => rgb,
            ref other => {
                return Err(format!("'{name}' must be a number or a color, not {}", other.element()));
            }
        };
        color = std::array::from_fn(|i| color[i] * factor[i]);
    }
    if parameters.is_empty() && plugin == "srgb" {
        return Err("the parameter 'color' is missing".into());
    }
    Ok(color)
}
