//! Numbers, truth values, vectors and colors as they are written in attributes.

use super::document::Element;
use crate::Result;

/// A finite number that single precision can hold.
pub(super) fn float(text: &str) -> std::result::Result<f64, String> {
    let number: f64 = text.trim().parse().map_err(|_| format!("'{}' is not a number", shorten(text)))?;
    if number.abs() <= f64::from(f32::MAX) {
        Ok(number)
    } else {
        Err(format!("'{}' is not finite in single precision", shorten(text)))
    }
}

/// Numbers separated by spaces or commas.
pub(super) fn floats(text: &str) -> std::result::Result<Vec<f64>, String> {
    let separator = |c: char| c.is_ascii_whitespace() || c == ',';
    text.split(separator).filter(|word| !word.is_empty()).map(float).collect()
}

/// A whole number.
pub(super) fn integer(text: &str) -> std::result::Result<i64, String> {
    text.trim().parse().map_err(|_| format!("'{}' is not a whole number", shorten(text)))
}

/// `true` or `false`.
pub(super) fn boolean(text: &str) -> std::result::Result<bool, String> {
    match text.trim() {
        text if text.eq_ignore_ascii_case("true") => Ok(true),
        text if text.eq_ignore_ascii_case("false") => Ok(false),
        _ => Err(format!("'{}' is neither true nor false", shorten(text))),
    }
}

/// Three numbers in one attribute.
pub(super) fn triple(text: &str) -> std::result::Result<[f64; 3], String> {
    let numbers = floats(text)?;
    let count = numbers.len();
    numbers.try_into().map_err(|_| format!("needs three numbers, has {count}"))
}

/// One number for all, or three.
pub(super) fn one_or_triple(text: &str) -> std::result::Result<[f64; 3], String> {
    match floats(text)?[..] {
        [x] => Ok([x; 3]),
        [x, y, z] => Ok([x, y, z]),
        ref all => Err(format!("needs one or three numbers, has {}", all.len())),
    }
}

/// A color: one number, three, or `#rrggbb` with linear components in 255ths.
pub(super) fn rgb(text: &str) -> std::result::Result<[f64; 3], String> {
    let Some(digits) = text.trim().strip_prefix('#') else { return one_or_triple(text) };
    let code = u32::from_str_radix(digits, 16).ok().filter(|_| digits.len() == 6 && !digits.starts_with('+'));
    let code = code.ok_or_else(|| format!("'{}' is not a color of the form #rrggbb", shorten(text)))?;
    let [_, r, g, b] = code.to_be_bytes();
    Ok([r, g, b].map(|component| f64::from(component) / 255.0))
}

/// `value="…"` with one or three numbers, or `x`, `y`, `z` with a default for those that are missing.
pub(super) fn vector(element: &Element<'_>, default: Option<f64>) -> Result<[f64; 3]> {
    let at = |message: String| element.error(message);
    if let Some(value) = element.get("value") {
        if ["x", "y", "z"].iter().any(|name| element.get(name).is_some()) {
            return Err(element.error("has both 'value' and 'x', 'y', 'z'"));
        }
        return one_or_triple(value).map_err(at);
    }
    let mut all = [0.0; 3];
    for (component, name) in all.iter_mut().zip(["x", "y", "z"]) {
        *component = match (element.get(name), default) {
            (Some(text), _) => float(text).map_err(at)?,
            (None, Some(default)) => default,
            (None, None) => return Err(element.error(format_args!("the attribute '{name}' is missing"))),
        };
    }
    Ok(all)
}

/// The start of a text, safe to print.
pub(super) fn shorten(text: &str) -> String {
    let start: String = text.chars().take(40).collect();
    let more = if start.len() < text.len() { "…" } else { "" };
    format!("{}{more}", start.escape_debug())
}
