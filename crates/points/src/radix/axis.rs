//! One coordinate: its number system, its generator and its randomization, and the walk along its rows.

use std::sync::{Arc, OnceLock};

use super::LANES;
use super::digitwise::{self, Digitwise};
use super::generator::{Generator, Shifted};
use super::linear::{self, Linear};
use super::nested::{self, Nested};
use super::places::{Places, TABULATED};
use super::prefixes::Prefixes;
use crate::Seed;
use crate::scramble::Randomization;

/// What a coordinate is before any randomization.
#[derive(Debug)]
pub(crate) struct Coordinate {
    pub(super) places: Places,
    pub(super) generator: Generator,
}

/// A randomized coordinate.
#[derive(Debug)]
pub(super) struct Axis {
    coordinate: Arc<Coordinate>,
    scramble: Scramble,
    table: OnceLock<Prefixes>,
}

#[derive(Debug)]
enum Scramble {
    Digitwise(Digitwise),
    Linear(Linear),
    Nested(Nested),
}

/// What is the same for all rows of a block.
#[derive(Debug, Default)]
struct Block {
    shifted: Shifted,
    addend: u64,
    sum: linear::Addend,
    digits: Vec<nested::Digit>,
}

/// What a walk needs for the rows of a moment; all axes may share it.
#[derive(Debug)]
pub(super) struct Scratch {
    numbers: [u32; LANES],
    prefixes: Prefixes,
}

impl Scratch {
    /// Room for up to [`LANES`] rows.
    pub(super) fn of(rows: usize) -> Self {
        Self { numbers: [0; LANES], prefixes: Prefixes::of(rows, 64) }
    }
}

/// A walk along the rows of an axis.
#[derive(Debug)]
pub(super) struct Walk<'a> {
    axis: &'a Axis,
    table: Option<&'a Prefixes>,
    low: u64,
    high: u64,
    block: Block,
}

impl Axis {
    pub(super) fn new(coordinate: Arc<Coordinate>, randomization: Randomization, key: Seed) -> Self {
        let places = &coordinate.places;
        let scramble = match randomization {
            Randomization::None
            | Randomization::Shift
            | Randomization::DigitalShift
            | Randomization::DigitPermutation => {
                Scramble::Digitwise(Digitwise::new(places, randomization, key))
            }
            Randomization::Linear | Randomization::LinearStriped | Randomization::LinearIBinomial => {
                Scramble::Linear(Linear::new(places, randomization, key))
            }
            Randomization::Owen | Randomization::OwenExact => {
                Scramble::Nested(Nested::new(places, randomization, key))
            }
            Randomization::ShiftTent => unreachable!("only lattices take it"),
        };
        Self { coordinate, scramble, table: OnceLock::new() }
    }

    /// The same coordinate with other randomness.
    pub(super) fn reseeded(&self, randomization: Randomization, key: Seed) -> Self {
        Self::new(self.coordinate.clone(), randomization, key)
    }

    pub(super) fn coord(&self, index: u64) -> f64 {
        let mut x = [0.0];
        self.walk(index, 1).write(&mut Scratch::of(1), &mut x);
        x[0]
    }

    /// A walk of some rows from one on. Tables are made where they save work, but never change a number.
    pub(super) fn walk(&self, start: u64, count: u64) -> Walk<'_> {
        let rows = self.coordinate.places.rows;
        let table = if rows <= TABULATED && count >= rows / 4 {
            Some(self.table.get_or_init(|| self.all_prefixes()))
        } else {
            self.table.get()
        };
        let mut walk =
            Walk { axis: self, table, low: start % rows, high: start / rows, block: Block::default() };
        walk.enter();
        walk
    }

    fn all_prefixes(&self) -> Prefixes {
        let places = &self.coordinate.places;
        match &self.scramble {
            Scramble::Digitwise(digitwise) => {
                Prefixes { words: digitwise.words(places), ..Prefixes::default() }
            }
            Scramble::Linear(linear) => linear.images(places),
            Scramble::Nested(nested) => {
                let nodes = nested.nodes(places);
                Prefixes {
                    words: nodes.iter().map(|node| places.edge(node.cell)).collect(),
                    fractions: nodes.iter().map(|node| node.fraction).collect(),
                    digits: vec![],
                }
            }
        }
    }

    /// Writes what is known of one prefix to a place of a scratch.
    fn one_prefix(&self, prefix: u64, to: &mut Prefixes, at: usize) {
        let places = &self.coordinate.places;
        match &self.scramble {
            Scramble::Digitwise(digitwise) => to.words[at] = digitwise.word(places, prefix),
            Scramble::Linear(linear) => linear.image(places, prefix, to, at),
            Scramble::Nested(nested) => {
                let node = nested.node(places, prefix);
                (to.words[at], to.fractions[at]) = (places.edge(node.cell), node.fraction);
            }
        }
    }
}

impl Walk<'_> {
    /// Writes the coordinates of the next rows, at most [`LANES`] of them.
    pub(super) fn write(&mut self, scratch: &mut Scratch, column: &mut [f64]) {
        let rows = self.axis.coordinate.places.rows;
        let mut rest = column;
        while !rest.is_empty() {
            if self.low == rows {
                (self.low, self.high) = (0, self.high + 1);
                self.enter();
            }
            let run = (rest.len() as u64).min(rows - self.low) as usize;
            let (now, later) = rest.split_at_mut(run);
            self.write_run(scratch, now);
            self.low += run as u64;
            rest = later;
        }
    }

    /// Prepares the block.
    fn enter(&mut self) {
        let Coordinate { places, generator } = &*self.axis.coordinate;
        let Block { shifted, addend, sum, digits } = &mut self.block;
        generator.shift(places, self.high, shifted);
        match &self.axis.scramble {
            Scramble::Digitwise(digitwise) => *addend = digitwise.addend(places, &shifted.high),
            Scramble::Linear(linear) => linear.add(places, &shifted.high, sum),
            Scramble::Nested(nested) => nested.digits(places, &shifted.high, digits),
        }
    }

    /// Rows of one block.
    fn write_run(&self, scratch: &mut Scratch, out: &mut [f64]) {
        let Coordinate { places, generator } = &*self.axis.coordinate;
        match (self.table, generator) {
            (Some(table), Generator::Identity) => self.finish(table, self.low as usize, out),
            (Some(table), Generator::Matrix(_)) => {
                let numbers = &mut scratch.numbers[..out.len()];
                generator.numbers(places, self.low, &self.block.shifted, numbers);
                Self::gather(table, numbers, &mut scratch.prefixes);
                self.finish(&scratch.prefixes, 0, out);
            }
            (None, _) => {
                for (at, low) in (0..out.len()).zip(self.low..) {
                    let prefix = generator.number(places, low, &self.block.shifted);
                    self.axis.one_prefix(prefix, &mut scratch.prefixes, at);
                }
                self.finish(&scratch.prefixes, 0, out);
            }
        }
    }

    /// Copies what is known of some prefixes.
    fn gather(table: &Prefixes, numbers: &[u32], to: &mut Prefixes) {
        for (word, &number) in to.words.iter_mut().zip(numbers) {
            *word = table.words[number as usize];
        }
        if !table.fractions.is_empty() {
            for (fraction, &number) in to.fractions.iter_mut().zip(numbers) {
                *fraction = table.fractions[number as usize];
            }
        }
        let digits =
            table.digits.chunks_exact(table.words.len()).zip(to.digits.chunks_exact_mut(to.words.len()));
        for (from, to) in digits {
            to.iter_mut().zip(numbers).for_each(|(digit, &number)| *digit = from[number as usize]);
        }
    }

    /// The randomized coordinates of prefixes from number `first` on.
    fn finish(&self, prefixes: &Prefixes, first: usize, out: &mut [f64]) {
        let (block, cell) = (&self.block, self.axis.coordinate.places.cell);
        match &self.axis.scramble {
            Scramble::Digitwise(_) => digitwise::finish(block.addend, &prefixes.words[first..], out),
            Scramble::Linear(_) => linear::finish(&block.sum, cell, prefixes, first, out),
            Scramble::Nested(_) => {
                let [words, fractions] = [&prefixes.words[first..], &prefixes.fractions[first..]];
                nested::finish(&block.digits, cell, words, fractions, out);
            }
        }
    }
}
