#![allow(missing_docs, unsafe_code, clippy::all, clippy::pedantic)]
use std::time::Instant;
use evenlight_points::{PointSet, Seed, sequences};
use std::arch::x86_64::*;
#[target_feature(enable = "avx512f")]
unsafe fn limit(out: &mut [f64], v: f64) {
    unsafe {
        let x = _mm512_set1_pd(v);
        let head = out.as_ptr().align_offset(64);
        let p = out.as_mut_ptr().add(head);
        for i in 0..(out.len() - head) / 8 { _mm512_stream_pd(p.add(8 * i), x) }
        _mm_sfence();
    }
}
fn main() {
    let mb: usize = std::env::args().nth(1).map_or(64, |s| s.parse().unwrap());
    let runs = 15;
    let mut out = vec![1.0_f64; (mb << 20) / 8];
    let mut out32 = vec![1.0_f32; (mb << 20) / 4];
    let dims: Vec<usize> = std::env::args().skip(2).map(|s| s.parse().unwrap()).collect();
    let time = |f: &mut dyn FnMut()| { let s = Instant::now(); f(); s.elapsed().as_secs_f64() };
    let n = out.len() as f64 / 1e6;
    let mut sets = vec![];
    for &d in &dims { for s in ["digital_shift", "owen"] { sets.push((d, s, sequences::build("sobol", d, s, Seed::new(1)).unwrap())); } }
    let mut res: Vec<Vec<f64>> = vec![vec![]; 2 + 2 * sets.len()];
    for _ in 0..runs {
        res[0].push(n / time(&mut || unsafe { limit(&mut out, 0.5) }));
        for (i, (d, _, p)) in sets.iter().enumerate() {
            let rows = out.len() / d; let places = rows * d;
            res[2 + 2 * i].push(n / time(&mut || p.fill(0..rows as u64, &mut out[..places])));
            res[0].push(n / time(&mut || unsafe { limit(&mut out, 0.5) }));
            let rows2 = out32.len() / d; let places2 = rows2 * d;
            res[3 + 2 * i].push(2.0 * n / time(&mut || p.fill_f32(0..rows2 as u64, &mut out32[..places2])));
        }
    }
    let med = |v: &Vec<f64>| { let mut v = v.clone(); v.sort_by(f64::total_cmp); (v[v.len() / 2], v[v.len() - 1]) };
    let lim = med(&res[0]);
    println!("limit f64 median {:.0} best {:.0}", lim.0, lim.1);
    for (i, (d, s, _)) in sets.iter().enumerate() {
        let (a, b) = (med(&res[2 + 2 * i]), med(&res[3 + 2 * i]));
        println!("{d:5} {s:14} f64 {:.0} {:.0} ({:.2})  f32 {:.0} {:.0} ({:.2})", a.0, a.1, a.0 / lim.0, b.0, b.1, b.0 / lim.0 / 2.0);
    }
}
