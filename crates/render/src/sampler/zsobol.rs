//! `zsobol`: the points of `sobol`, but one sequence for all pixels of an image instead of one for each.
//!
//! Pixels take their samples along the Morton curve, and the nested shuffle of `sobol` lets the halves of each square and strip of pixels
//! change places, differently for each quadruple of dimensions. So pixels that are near each other share a net: an error is as
//! large as that of `sobol`, but its neighbors are of the other sign, and what is left after a blur, by a denoiser or by the eye, is less.
//! Choose it for images that are looked at; not where pixels are to be independent of each other.

use crate::sampler::{Entry, Sharing, sobol};

pub(crate) const ENTRY: Entry = Entry {
    name: "zsobol",
    cite: "Ahmed & Wonka 2020, Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of \
           Pixels, ACM Trans. Graph. 39(6)",
    sharing: Sharing::Image,
    ..sobol::ENTRY
};
