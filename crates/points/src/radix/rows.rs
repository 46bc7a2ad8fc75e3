//! From columns to rows: coordinates are made one axis after the other, and wanted point after point.

use super::LANES;
use crate::convert::Unit;
use crate::instruction_sets::for_this_machine;
use crate::streaming::{self, Stream, store};

/// Axes whose coordinates are brought to their rows together: one line of cache for each row.
pub(super) const AXES: usize = 8;

/// Coordinates of some axes.
pub(super) type Columns = [[f64; LANES]; AXES];

for_this_machine! {
    /// Writes columns into rows of `width` numbers, of which the first column is number `first`.
    interleave = interleave_body(columns: &Columns, first: usize, width: usize, rows: &mut [f64])
}

#[inline(always)]
fn interleave_body(columns: &Columns, first: usize, width: usize, rows: &mut [f64]) {
    let count = (width - first).min(AXES);
    for (i, row) in rows.chunks_exact_mut(width).enumerate() {
        let part = &mut row[first..];
        if let Some(part) = part.first_chunk_mut::<AXES>() {
            *part = std::array::from_fn(|axis| columns[axis][i]);
        } else {
            part[..count].iter_mut().zip(columns).for_each(|(x, column)| *x = column[i]);
        }
    }
}

for_this_machine! {
    /// Writes rows past the caches.
    past_caches = past_caches_body<T: Unit, VECTOR>(rows: &[T], out: &mut Stream<'_, T>)
}

#[inline(always)]
fn past_caches_body<T: Unit, const VECTOR: usize>(rows: &[T], out: &mut Stream<'_, T>) {
    let (begun, rows) = rows.split_at(out.lacking().min(rows.len()));
    write_part(begun, out);
    let (lines, rest) = rows.as_chunks();
    for (line, to) in lines.iter().zip(out.take_lines(lines.len())) {
        store::<T, VECTOR>(true, line, to);
    }
    write_part(rest, out);
}

/// Less than a line.
#[inline(always)]
fn write_part<T: Unit>(numbers: &[T], out: &mut Stream<'_, T>) {
    if !numbers.is_empty() {
        let mut line = [T::default(); streaming::LANES];
        line[..numbers.len()].copy_from_slice(numbers);
        out.write_part(&line, numbers.len());
    }
}
