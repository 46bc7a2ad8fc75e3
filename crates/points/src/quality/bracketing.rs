//! Guaranteed upper bounds of the star discrepancy, by brackets that are refined where they are worst.
//!
//! A bracket is a pair of boxes, one in the other; every box between them has a volume and a number of points between theirs,
//! so its discrepancy is bounded by the difference. All boxes begin as one bracket; the bracket with the largest bound is
//! split in two, as often as is asked, and the largest bound that is left holds for all boxes. E. Thiémard, *An algorithm to
//! compute bounds for the star discrepancy*, J. Complexity 17, 2001, has a fixed cover of brackets of equal weight; here
//! refinement goes where the points need it, and it can be stopped at any time. When no bracket beats the worst
//! box that was met, the bound is the discrepancy itself.
//!
//! O(n d) time and O(d) memory for a bracket.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::Rows;
use super::cuts::Cuts;
use super::sweep::Extremum;

/// How far to refine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// The most brackets to make.
    pub brackets: u64,
    /// Stop when upper and lower bound differ by no more.
    pub width: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Self { brackets: 1 << 17, width: 0.0 }
    }
}

/// What is known of the discrepancy.
#[derive(Clone, Debug, PartialEq)]
pub struct Bounds {
    /// No box has more.
    pub upper: f64,
    /// This box has so much.
    pub lower: Extremum,
}

/// All boxes with cuts in some ranges.
struct Bracket {
    bound: f64,
    least: Vec<u32>,
    most: Vec<u32>,
    /// The points below all least cuts, and below all largest.
    inside: usize,
    total: usize,
}

impl PartialEq for Bracket {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Bracket {}

impl PartialOrd for Bracket {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Bracket {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

/// Bounds that hold, and the worst box that was met, at least as bad as `known`. `progress` is told which part of the
/// brackets is made, and stops by returning false.
pub fn bracketing(
    rows: &Rows<'_>,
    known: Extremum,
    limits: Limits,
    progress: &mut dyn FnMut(f64) -> bool,
) -> Bounds {
    let cuts = Cuts::new(rows);
    let mut best = known;
    let mut heap = BinaryHeap::from([root(&cuts)]);
    let mut made = 1;
    while let Some(worst) = heap.peek() {
        if worst.bound <= best.value + limits.width || made >= limits.brackets {
            break;
        }
        if made % 4096 < 2 && !progress(made as f64 / limits.brackets as f64) {
            break;
        }
        let bracket = heap.pop().expect("it was there the line before");
        let Some(dim) = widest(&cuts, &bracket) else { continue };
        for half in split(&cuts, &bracket, dim) {
            corners(&cuts, &half, &mut best);
            if half.bound > best.value {
                heap.push(half);
            }
        }
        made += 2;
    }
    Bounds { upper: heap.peek().map_or(best.value, |worst| worst.bound.max(best.value)), lower: best }
}

fn root(cuts: &Cuts) -> Bracket {
    let most = (0..cuts.dims).map(|dim| cuts.most(dim)).collect();
    Bracket { bound: 1.0, least: vec![0; cuts.dims], most, inside: 0, total: cuts.n }
}

/// The coordinate in which the two boxes differ most in proportion; none if they are the same.
fn widest(cuts: &Cuts, bracket: &Bracket) -> Option<usize> {
    let ratio =
        |&dim: &usize| cuts.grown(dim, bracket.most[dim]) / cuts.shrunk(dim, bracket.least[dim]).max(1e-300);
    (0..cuts.dims)
        .filter(|&dim| bracket.least[dim] < bracket.most[dim])
        .max_by(|a, b| ratio(a).total_cmp(&ratio(b)))
}

/// The brackets of the smaller and of the larger cuts of a coordinate.
fn split(cuts: &Cuts, bracket: &Bracket, dim: usize) -> [Bracket; 2] {
    let (least, most) = (bracket.least[dim], bracket.most[dim]);
    let middle = (cuts.grown(dim, most) * cuts.shrunk(dim, least)).sqrt();
    let at = cuts.cut_at(dim, middle).clamp(least, most - 1);
    let (mut smaller, mut larger) = (bracket.most.clone(), bracket.least.clone());
    (smaller[dim], larger[dim]) = (at, at + 1);
    let (total, inside) = (cuts.count(&smaller), cuts.count(&larger));
    [
        bounded(cuts, Bracket { bound: 0.0, least: bracket.least.clone(), most: smaller, total, ..*bracket }),
        bounded(cuts, Bracket { bound: 0.0, least: larger, most: bracket.most.clone(), inside, ..*bracket }),
    ]
}

fn grown(cuts: &Cuts, cut: &[u32]) -> f64 {
    cut.iter().enumerate().map(|(dim, &cut)| cuts.grown(dim, cut)).product()
}

fn shrunk(cuts: &Cuts, cut: &[u32]) -> f64 {
    cut.iter().enumerate().map(|(dim, &cut)| cuts.shrunk(dim, cut)).product()
}

fn bounded(cuts: &Cuts, mut bracket: Bracket) -> Bracket {
    let n = cuts.n as f64;
    let few = grown(cuts, &bracket.most) - bracket.inside as f64 / n;
    let many = bracket.total as f64 / n - shrunk(cuts, &bracket.least);
    bracket.bound = few.max(many);
    bracket
}

/// Tries the two boxes of a bracket as they are: the smaller open one and the larger closed one.
fn corners(cuts: &Cuts, bracket: &Bracket, best: &mut Extremum) {
    let n = cuts.n as f64;
    let few = grown(cuts, &bracket.least) - bracket.inside as f64 / n;
    let many = bracket.total as f64 / n - shrunk(cuts, &bracket.most);
    if few.max(many) <= best.value {
        return;
    }
    let closed = many > few;
    let cut = if closed { &bracket.most } else { &bracket.least };
    let face = |(dim, &cut)| if closed { cuts.shrunk(dim, cut) } else { cuts.grown(dim, cut) };
    let corner = cut.iter().enumerate().map(face).collect();
    *best = Extremum { value: few.max(many), corner, closed };
}
