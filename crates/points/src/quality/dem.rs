//! The exact star discrepancy in d dimensions: the algorithm of Dobkin, Eppstein and Mitchell, with bounds.
//!
//! All boxes are split into cells, one coordinate after the other, such that a point that a cell leaves open is open in one
//! coordinate only, and there are at most about √n of them in each. In such a cell the points inside a box are a sum over
//! coordinates, and the worst box is found by dynamic programming. There are O(n^{d/2}) cells and
//! O(n) steps in each: O(n^{1+d/2}) at the most.
//!
//! Here a cell whose bound is no better than a box that is already known is left out, and in the others only those
//! counts are tried that could be better; most of the time goes into cells that are never opened. [`estimate`] says
//! beforehand how many steps it will be, by random descents into the tree of cells (D. Knuth, *Estimating the efficiency of
//! backtrack programs*, Math. Comp. 29, 1975).
//!
//! D. Dobkin, D. Eppstein and D. Mitchell, *Computing the discrepancy with applications to supersampling patterns*, ACM
//! Trans. Graphics 15, 1996.

use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;

use super::Rows;
use super::cuts::Cuts;
use super::dem_leaf::Leaf;
use super::sweep::Extremum;
use crate::Seed;

/// A coordinate that is in no list: the point is below all cuts of the cell so far.
const INSIDE: u8 = u8::MAX;

/// A point that some box of a cell contains, and the coordinate that decides whether a box does.
#[derive(Clone, Copy)]
pub(super) struct Live {
    pub(super) point: u32,
    pub(super) open: u8,
}

/// Cells that have the same cuts in the coordinates that were split.
struct Cell {
    live: Vec<Live>,
    /// The least and the largest cut of each coordinate that was split.
    ranges: Vec<(u32, u32)>,
    /// The largest volume of an open and the least of a closed box, in these coordinates.
    grown: f64,
    shrunk: f64,
}

/// What the search needs to know.
struct Search<'a> {
    cuts: &'a Cuts,
    /// How many points a coordinate may leave open.
    room: usize,
}

/// The worst box, if there is any that is worse than `known`. `progress` is told which part is done, and stops the
/// search by returning false; then there is no result.
///
/// The same bits for any number of `workers`.
pub fn dem(
    rows: &Rows<'_>,
    known: Extremum,
    workers: NonZeroUsize,
    progress: &mut dyn FnMut(f64) -> bool,
) -> Option<Extremum> {
    let cuts = Cuts::new(rows);
    let search = Search::new(&cuts);
    let tasks = search.tasks(known.value);
    let (next, stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
    let mut found: Vec<Option<Extremum>> = vec![None; tasks.len()];
    std::thread::scope(|scope| {
        let (sender, receiver) = mpsc::channel();
        for _ in 0..workers.get().min(tasks.len()) {
            let (sender, tasks, search, known, next, stopped) =
                (sender.clone(), &tasks, &search, &known, &next, &stopped);
            scope.spawn(move || {
                while let Some(cell) = tasks.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let mut best = known.clone();
                    search.open(cell, &mut best, stopped);
                    if stopped.load(Ordering::Relaxed) || sender.send((cell.0, best)).is_err() {
                        break;
                    }
                }
            });
        }
        drop(sender);
        for (done, (task, best)) in receiver.iter().enumerate() {
            found[task] = Some(best);
            if !progress((done + 1) as f64 / tasks.len() as f64) {
                stopped.store(true, Ordering::Relaxed);
            }
        }
    });
    found.into_iter().try_fold(known, |best, one| Some(best.or(one?)))
}

/// About how many steps [`dem`] will take, of some nanoseconds each, if it starts from a box of discrepancy `known`: the
/// mean over `probes` random descents, unbiased but with a spread of its own.
pub fn estimate(rows: &Rows<'_>, known: f64, probes: u32, seed: Seed) -> f64 {
    let cuts = Cuts::new(rows);
    let search = Search::new(&cuts);
    let one = |probe: u32| search.probe(known, seed.replicate(u64::from(probe)));
    (0..probes).map(one).sum::<f64>() / f64::from(probes)
}

impl<'a> Search<'a> {
    fn new(cuts: &'a Cuts) -> Self {
        Self { cuts, room: (cuts.n as f64).sqrt().ceil() as usize }
    }

    /// All boxes.
    fn root(&self) -> Cell {
        let live = (0..self.cuts.n as u32).map(|point| Live { point, open: INSIDE }).collect();
        Cell { live, ranges: Vec::with_capacity(self.cuts.dims), grown: 1.0, shrunk: 1.0 }
    }

    /// Numbered cells of the first coordinates: pieces of work.
    fn tasks(&self, known: f64) -> Vec<(usize, Cell)> {
        let mut cells = vec![self.root()];
        for _ in 0..2.min(self.cuts.dims - 1) {
            cells = cells.into_iter().flat_map(|mut cell| self.children(&mut cell, known)).collect();
        }
        cells.into_iter().enumerate().collect()
    }

    fn open(&self, (_, cell): &(usize, Cell), best: &mut Extremum, stopped: &AtomicBool) {
        let mut cell = Cell {
            live: cell.live.clone(),
            ranges: cell.ranges.clone(),
            grown: cell.grown,
            shrunk: cell.shrunk,
        };
        self.search(&mut cell, best, stopped);
    }

    fn search(&self, cell: &mut Cell, best: &mut Extremum, stopped: &AtomicBool) {
        if cell.ranges.len() + 1 == self.cuts.dims {
            return self.last(cell, best);
        }
        for mut child in self.children(cell, best.value) {
            if stopped.load(Ordering::Relaxed) {
                return;
            }
            self.search(&mut child, best, stopped);
        }
    }

    /// Where to split the next coordinate: ranges of cuts in which only so many points are open, and none that was
    /// open before. Sorts the live points of the cell by this coordinate.
    fn pieces(&self, cell: &mut Cell) -> Vec<(u32, u32)> {
        let dim = cell.ranges.len();
        let rank = |live: &Live| self.cuts.ranks(live.point as usize)[dim];
        cell.live.sort_unstable_by_key(|live| (rank(live), live.point));
        let (mut pieces, mut least, mut open) = (Vec::new(), 0, 0);
        for group in cell.live.chunk_by(|a, b| rank(a) == rank(b)) {
            if group.iter().any(|live| live.open != INSIDE) || open + group.len() > self.room {
                pieces.push((least, rank(&group[0])));
                (least, open) = (rank(&group[0]) + 1, 0);
            } else {
                open += group.len();
            }
        }
        pieces.push((least, self.cuts.most(dim)));
        pieces
    }

    /// The cells of the next coordinate that may hold something worse than `known`.
    fn children(&self, cell: &mut Cell, known: f64) -> Vec<Cell> {
        let (dim, n) = (cell.ranges.len(), self.cuts.n as f64);
        let rank = |live: &Live| self.cuts.ranks(live.point as usize)[dim];
        let mut found = Vec::new();
        for (least, most) in self.pieces(cell) {
            let total = cell.live.partition_point(|live| rank(live) < most);
            let grown = cell.grown * self.cuts.grown(dim, most);
            if grown <= known && total as f64 / n <= known {
                continue;
            }
            let live = cell.live[..total].iter().map(|live| {
                let open = if rank(live) < least { live.open } else { dim as u8 };
                Live { point: live.point, open }
            });
            let mut ranges = Vec::with_capacity(self.cuts.dims);
            ranges.extend_from_slice(&cell.ranges);
            ranges.push((least, most));
            let shrunk = cell.shrunk * self.cuts.shrunk(dim, least);
            found.push(Cell { live: live.collect(), ranges, grown, shrunk });
        }
        found
    }

    /// Splits the last coordinate, and searches the leaves.
    fn last(&self, cell: &mut Cell, best: &mut Extremum) {
        self.leaves(cell, |leaf| leaf.search(best));
    }

    /// Calls `visit` with every leaf of a cell that has one coordinate to go.
    fn leaves(&self, cell: &mut Cell, mut visit: impl FnMut(Leaf<'_>)) {
        let (dim, pieces) = (cell.ranges.len(), self.pieces(cell));
        let rank = |live: &Live| self.cuts.ranks(live.point as usize)[dim];
        let (mut below, mut at) = (0, 0);
        cell.ranges.push((0, 0));
        for (least, most) in pieces {
            while at < cell.live.len() && rank(&cell.live[at]) < least {
                below += usize::from(cell.live[at].open == INSIDE);
                at += 1;
            }
            let total = at + cell.live[at..].partition_point(|live| rank(live) < most);
            cell.ranges[dim] = (least, most);
            visit(Leaf {
                cuts: self.cuts,
                ranges: &cell.ranges,
                live: &cell.live[..total],
                first_open: at,
                below,
                grown: cell.grown * self.cuts.grown(dim, most),
                shrunk: cell.shrunk * self.cuts.shrunk(dim, least),
            });
        }
        cell.ranges.pop();
    }

    /// The steps on one random way down, times the ways there were.
    fn probe(&self, known: f64, seed: Seed) -> f64 {
        let (mut cell, mut ways, mut steps) = (self.root(), 1.0, 0.0);
        while cell.ranges.len() + 1 < self.cuts.dims {
            let mut children = self.children(&mut cell, known);
            steps += ways * children.iter().map(|child| child.live.len() as f64 + 64.0).sum::<f64>();
            if children.is_empty() {
                return steps;
            }
            let choice = seed.split(16, cell.ranges.len() as u64).bits64() % children.len() as u64;
            ways *= children.len() as f64;
            cell = children.swap_remove(choice as usize);
        }
        steps += ways * cell.live.len() as f64;
        self.leaves(&mut cell, |leaf| steps += ways * leaf.steps(known));
        steps
    }
}
