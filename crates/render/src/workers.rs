//! Jobs on any number of threads whose results come in order, so that nothing depends on who was faster.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::time::{Duration, Instant};

/// How long the caller is not asked again whether to go on.
const PATIENCE: Duration = Duration::from_millis(100);

/// What the caller is told, on its own thread.
pub(crate) enum News<T> {
    /// The result of a job; jobs come in the order of their numbers.
    Done(usize, T),
    /// A tenth of a second has passed: the time to show progress, and to set the flag that stops the work.
    Time,
}

/// Do the jobs `0..count` with `threads` workers, 0 for one per core. After `stop` is set no job begins, and one that finds it set may
/// give up: `None`.
pub(crate) fn in_order<T: Send>(
    count: usize,
    threads: usize,
    stop: &AtomicBool,
    job: impl Fn(usize) -> Option<T> + Sync,
    tell: &mut dyn FnMut(News<T>),
) {
    let threads = match threads {
        0 => std::thread::available_parallelism().map_or(1, usize::from),
        threads => threads,
    };
    let next = AtomicUsize::new(0);
    let take = || {
        let wanted = !stop.load(Ordering::Relaxed);
        wanted.then(|| next.fetch_add(1, Ordering::Relaxed)).filter(|number| *number < count)
    };
    std::thread::scope(|scope| {
        let (sender, finished) = mpsc::channel();
        for _ in 0..threads.min(count) {
            let sender = sender.clone();
            scope.spawn(|| {
                let sender = sender;
                while let Some(number) = take() {
                    if let Some(result) = job(number) {
                        // the receiver only goes away when nobody wants the result any more
                        let _ = sender.send((number, result));
                    }
                }
            });
        }
        drop(sender);
        let mut waiting = BTreeMap::new();
        let mut told = 0;
        let mut asked = Instant::now();
        loop {
            match finished.recv_timeout(PATIENCE.saturating_sub(asked.elapsed())) {
                Ok((number, result)) => drop(waiting.insert(number, result)),
                Err(mpsc::RecvTimeoutError::Timeout) => {}
                Err(mpsc::RecvTimeoutError::Disconnected) => break,
            }
            // also when results come in one after the other
            if asked.elapsed() >= PATIENCE {
                tell(News::Time);
                asked = Instant::now();
            }
            while let Some(result) = waiting.remove(&told) {
                tell(News::Done(told, result));
                told += 1;
            }
        }
    });
}
