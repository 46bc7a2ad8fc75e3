//! The largest of many lines while time goes on: a kinetic segment tree.
//!
//! Every slot has a line, height + slope × now. The tree knows which line is on top; slots may be lifted from some slot
//! on, lines may be replaced, and `now` moves forward. A node keeps the time until which the order below it stays as it
//! is, so that moving on costs only where the order changes: O(log² n) amortized for each operation.
//!
//! J. Basch, L. Guibas and J. Hershberger, *Data structures for mobile data*, J. Algorithms 31, 1999.

/// A tree over lines; node i has the children 2i and 2i + 1, the leaves begin at `size`.
pub(super) struct Kinetic {
    size: usize,
    now: f64,
    slopes: Vec<f64>,
    nodes: Vec<Node>,
}

/// The slot on top below a node, its height without what nodes further up add, what this node adds to all slots below, and
/// until when the slot on top is known.
#[derive(Clone, Copy)]
struct Node {
    slot: u32,
    height: f64,
    added: f64,
    until: f64,
}

impl Kinetic {
    /// Lines of these slopes, all of them of the same height, at time 0.
    pub(super) fn new(slopes: Vec<f64>, height: f64) -> Self {
        let size = slopes.len().next_power_of_two();
        let blank = Node { slot: 0, height: f64::NEG_INFINITY, added: 0.0, until: f64::INFINITY };
        let mut nodes = vec![blank; 2 * size];
        for (slot, node) in nodes[size..].iter_mut().take(slopes.len()).enumerate() {
            (node.slot, node.height) = (slot as u32, height);
        }
        let mut tree = Self { size, now: 0.0, slopes, nodes };
        (1..size).rev().for_each(|node| tree.pull(node));
        tree
    }

    /// Lifts all slots from `slot` on.
    pub(super) fn lift_from(&mut self, slot: usize, by: f64) {
        if slot >= self.slopes.len() {
            return;
        }
        let mut node = slot + self.size;
        self.nodes[node].height += by;
        while node > 1 {
            if node.is_multiple_of(2) {
                let right = &mut self.nodes[node + 1];
                right.height += by;
                right.added += by;
            }
            node /= 2;
            self.pull(node);
        }
    }

    /// The height of a slot's line at time 0.
    pub(super) fn height(&self, slot: usize) -> f64 {
        let leaf = slot + self.size;
        self.nodes[leaf].height + self.added_above(leaf)
    }

    /// Gives a slot another line.
    pub(super) fn set(&mut self, slot: usize, slope: f64, height: f64) {
        let mut node = slot + self.size;
        self.slopes[slot] = slope;
        self.nodes[node].height = height - self.added_above(node);
        while node > 1 {
            node /= 2;
            self.pull(node);
        }
    }

    /// Moves on to a later time; the slot on top.
    pub(super) fn top(&mut self, now: f64) -> Option<usize> {
        self.now = now;
        self.refresh(1);
        let Node { slot, height, .. } = self.nodes[1];
        (height > f64::NEG_INFINITY).then_some(slot as usize)
    }

    fn added_above(&self, leaf: usize) -> f64 {
        let above = std::iter::successors(Some(leaf / 2), |node| Some(node / 2));
        above.take_while(|&node| node > 0).map(|node| self.nodes[node].added).sum()
    }

    fn refresh(&mut self, node: usize) {
        if node < self.size && self.nodes[node].until <= self.now {
            self.refresh(2 * node);
            self.refresh(2 * node + 1);
            self.pull(node);
        }
    }

    /// Makes a node anew from its children.
    fn pull(&mut self, node: usize) {
        let (left, right) = (self.nodes[2 * node], self.nodes[2 * node + 1]);
        let slope = |child: Node| self.slopes[child.slot as usize];
        let value = |child: Node| child.height + slope(child) * self.now;
        let later = value(right) > value(left) || value(right) == value(left) && slope(right) > slope(left);
        let (top, other) = if later { (right, left) } else { (left, right) };
        let crossing = if slope(other) > slope(top) && other.height > f64::NEG_INFINITY {
            (top.height - other.height) / (slope(other) - slope(top))
        } else {
            f64::INFINITY
        };
        let Node { added, .. } = self.nodes[node];
        let until = crossing.min(left.until).min(right.until);
        self.nodes[node] = Node { slot: top.slot, height: top.height + added, added, until };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Seed;

    #[test]
    fn the_line_on_top_is_that_of_a_plain_search() {
        for case in 0..200 {
            let uniform = |tag, i| crate::convert::unit_f64(Seed::new(case).split(tag, i).bits64());
            let slots = 1 + (uniform(20, 0) * 40.0) as usize;
            let slopes: Vec<f64> = (0..slots as u64).map(|i| uniform(21, i) * 2.0 - 1.0).collect();
            let (mut lines, mut tree) = (vec![(0.0, 0.0); slots], Kinetic::new(slopes.clone(), 0.0));
            lines.iter_mut().zip(slopes).for_each(|(line, slope)| line.0 = slope);
            for step in 0..60 {
                let slot = (uniform(22, step) * slots as f64) as usize;
                if step % 5 == 4 {
                    lines[slot] = (uniform(23, step), uniform(24, step) * 3.0);
                    tree.set(slot, lines[slot].0, lines[slot].1);
                } else {
                    let by = uniform(23, step) - 0.5;
                    lines[slot..].iter_mut().for_each(|line| line.1 += by);
                    tree.lift_from(slot, by);
                }
                let now = step as f64 / 20.0;
                let value = |line: &(f64, f64)| line.0 * now + line.1;
                let found = value(&lines[tree.top(now).expect("there are lines")]);
                let wanted = lines.iter().map(value).fold(f64::NEG_INFINITY, f64::max);
                assert!((found - wanted).abs() < 1e-12, "case {case}, step {step}: {found}, {wanted}");
                assert!((tree.height(slot) - lines[slot].1).abs() < 1e-12);
            }
        }
    }
}
