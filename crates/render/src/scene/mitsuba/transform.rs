//! `<transform>`: operations in file order, each applied after those before it.

use glam::{DMat4, DVec3, DVec4};

use super::document::Element;
use super::values::{float, floats, triple, vector};
use crate::Result;

/// Apply one operation after `transform`.
pub(super) fn apply(operation: &Element<'_>, transform: DMat4) -> Result<DMat4> {
    let xyz = ["x", "y", "z", "value"];
    let matrix = match operation.name {
        "translate" => {
            operation.allow(&[], &xyz)?;
            DMat4::from_translation(vector(operation, Some(0.0))?.into())
        }
        "scale" => {
            operation.allow(&[], &xyz)?;
            DMat4::from_scale(vector(operation, Some(1.0))?.into())
        }
        "rotate" => {
            operation.allow(&["angle"], &xyz)?;
            rotate(operation)?
        }
        "lookat" => {
            operation.allow(&["origin", "target"], &["up"])?;
            look_at(operation)?
        }
        "matrix" => {
            operation.allow(&["value"], &[])?;
            matrix(operation)?
        }
        _ => {
            let known = "known in a <transform>: lookat, matrix, rotate, scale, translate";
            return Err(operation.error(format_args!("unknown operation; {known}")));
        }
    };
    Ok(matrix * transform)
}

/// Insist on finite numbers that single precision can hold; `to_world` must also have an inverse.
pub(super) fn check(name: &str, transform: DMat4) -> std::result::Result<DMat4, String> {
    let most = f64::from(f32::MAX);
    if !transform.to_cols_array().iter().all(|x| x.abs() <= most) {
        return Err(format!("the transform '{name}' is not finite"));
    }
    // Relative to the lengths of the columns: a very small object is no reason to complain.
    let linear = [transform.x_axis, transform.y_axis, transform.z_axis];
    let sizes: f64 = linear.iter().map(|column| column.length()).product();
    if name == "to_world" && transform.determinant().abs() <= 1e-14 * sizes {
        return Err(format!("the transform '{name}' is singular: it flattens space and has no inverse"));
    }
    Ok(transform)
}

/// The axis need not be a unit vector. (Mitsuba 3.9.1 puts it into the formula as it is and gets no rotation.)
fn rotate(operation: &Element<'_>) -> Result<DMat4> {
    let axis = DVec3::from(vector(operation, Some(0.0))?).try_normalize();
    let axis = axis.ok_or_else(|| operation.error("the axis has no direction"))?;
    let angle = float(operation.required("angle")).map_err(|message| operation.error(message))?;
    Ok(DMat4::from_axis_angle(axis, angle.to_radians()))
}

/// A camera at `origin` that looks along its z axis to `target`, with its x axis to the left.
fn look_at(operation: &Element<'_>) -> Result<DMat4> {
    let point = |name: &str| {
        let numbers = triple(operation.required(name));
        numbers.map(DVec3::from).map_err(|message| operation.error(format_args!("'{name}' {message}")))
    };
    let (origin, target) = (point("origin")?, point("target")?);
    let up = if operation.get("up").is_some_and(|up| !up.is_empty()) { point("up")? } else { DVec3::ZERO };
    let direction = (target - origin).try_normalize();
    let direction = direction.ok_or_else(|| operation.error("'origin' and 'target' are the same"))?;
    let up = if up == DVec3::ZERO { some_tangent(direction) } else { up };
    let left = up.cross(direction).try_normalize();
    let left = left.ok_or_else(|| operation.error("'up' is parallel to the direction of view"))?;
    let new_up = direction.cross(left);
    Ok(DMat4::from_cols(left.extend(0.0), new_up.extend(0.0), direction.extend(0.0), origin.extend(1.0)))
}

/// The tangent Mitsuba takes for up when none is given (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
fn some_tangent(n: DVec3) -> DVec3 {
    let sign = 1.0_f64.copysign(n.z);
    let a = -1.0 / (sign + n.z);
    DVec3::new(1.0 + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x)
}

/// Row by row: 16 numbers, or 9 for the linear part.
fn matrix(operation: &Element<'_>) -> Result<DMat4> {
    let numbers = floats(operation.required("value")).map_err(|message| operation.error(message))?;
    let matrix = match numbers.len() {
        16 => DMat4::from_cols_slice(&numbers).transpose(),
        9 => DMat4::from_mat3(glam::DMat3::from_cols_slice(&numbers).transpose()),
        count => return Err(operation.error(format_args!("needs 9 or 16 numbers, has {count}"))),
    };
    if matrix.row(3) != DVec4::W {
        return Err(operation.error("the last row must be 0 0 0 1"));
    }
    Ok(matrix)
}
