//! `catmullrom`: the interpolating cubic with negative lobes; sharper than `mitchell`, rings more.

use crate::Result;
use crate::filter::{Entry, Filter, mitchell};
use crate::scene::properties::Properties;

pub(crate) const ENTRY: Entry = Entry { name: "catmullrom", build };

#[expect(clippy::unnecessary_wraps, reason = "the registry's signature")]
fn build(_: &Properties<'_>) -> Result<Filter> {
    Ok(Filter::tabulate(ENTRY.name, 2.0, |x| mitchell::cubic(0.0, 0.5, x.abs())))
}
