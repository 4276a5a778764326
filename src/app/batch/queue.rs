//! Runs tasks in parallel and delivers their results in order.

use crate::base::sync::lock;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::{Condvar, Mutex, PoisonError};
use std::thread;

/// Limit, in tasks for each worker, of how far tasks run ahead of the consumed results: more pictures would only fill
/// the memory.
const AHEAD: usize = 2;

/// Progress of the queue.
struct State<R> {
    /// The next task to begin.
    next: usize,
    /// The next result to deliver.
    taken: usize,
    done: BTreeMap<usize, thread::Result<R>>,
    is_over: bool,
}

/// Runs the tasks 0 to `count`, `workers` of them in parallel, and passes the results in order to `take` on the calling
/// thread, until `take` breaks off: tasks in progress are then finished and dropped.
///
/// # Panics
/// When a task panics, at its position in the order.
pub fn in_order<R: Send, B>(
    count: usize,
    workers: usize,
    work: impl Fn(usize) -> R + Sync,
    mut take: impl FnMut(usize, R) -> ControlFlow<B>,
) -> Option<B> {
    let workers = workers.clamp(1, count.max(1));
    let state = Mutex::new(State {
        next: 0,
        taken: 0,
        done: BTreeMap::new(),
        is_over: false,
    });
    let changed = Condvar::new();
    let worker = || {
        while let Some(number) = begin(&state, &changed, count, workers * AHEAD) {
            let result = catch_unwind(AssertUnwindSafe(|| work(number)));
            lock(&state).done.insert(number, result);
            changed.notify_all();
        }
    };
    thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(worker);
        }
        let mut end = None;
        for number in 0..count {
            let result = match next_result(&state, &changed, number) {
                Ok(result) => result,
                Err(panic) => {
                    lock(&state).is_over = true;
                    changed.notify_all();
                    resume_unwind(panic)
                }
            };
            if let ControlFlow::Break(reason) = take(number, result) {
                end = Some(reason);
                break;
            }
        }
        lock(&state).is_over = true;
        changed.notify_all();
        end
    })
}

/// Waits until a task may begin, and returns its number.
fn begin<R>(
    state: &Mutex<State<R>>,
    changed: &Condvar,
    count: usize,
    ahead: usize,
) -> Option<usize> {
    let waits = |state: &mut State<R>| {
        !state.is_over && state.next < count && state.next >= state.taken + ahead
    };
    let mut state = changed
        .wait_while(lock(state), waits)
        .unwrap_or_else(PoisonError::into_inner);
    let number = state.next;
    let goes_on = !state.is_over && number < count;
    state.next += usize::from(goes_on);
    goes_on.then_some(number)
}

fn next_result<R>(state: &Mutex<State<R>>, changed: &Condvar, number: usize) -> thread::Result<R> {
    let mut guard = lock(state);
    loop {
        if let Some(result) = guard.done.remove(&number) {
            guard.taken = number + 1;
            changed.notify_all();
            return result;
        }
        guard = changed.wait(guard).unwrap_or_else(PoisonError::into_inner);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;

    #[test]
    fn results_come_in_the_order_of_the_work() {
        let mut taken = Vec::new();
        let slow_when_even = |number: usize| {
            thread::sleep(Duration::from_millis(if number.is_multiple_of(2) {
                3
            } else {
                0
            }));
            number * number
        };
        let end = in_order(20, 4, slow_when_even, |number, result| {
            taken.push((number, result));
            ControlFlow::<()>::Continue(())
        });
        assert_eq!(end, None);
        assert_eq!(taken, (0..20).map(|n| (n, n * n)).collect::<Vec<_>>());
    }

    #[test]
    fn tasks_start_only_slightly_ahead_and_never_after_the_end() {
        let begun = AtomicUsize::new(0);
        let work = |number: usize| {
            begun.fetch_max(number, Ordering::Relaxed);
        };
        let end = in_order(1000, 2, work, |number, ()| {
            thread::sleep(Duration::from_millis(5));
            if number == 3 {
                return ControlFlow::Break("enough");
            }
            ControlFlow::Continue(())
        });
        assert_eq!(end, Some("enough"));
        assert!(begun.into_inner() <= 4 + 2 * AHEAD);
    }

    #[test]
    fn a_panic_comes_in_its_turn() {
        let mut taken = 0;
        let broken = catch_unwind(AssertUnwindSafe(|| {
            in_order(
                9,
                3,
                |number| assert!(number != 4, "four"),
                |_, ()| {
                    taken += 1;
                    ControlFlow::<()>::Continue(())
                },
            )
        }));
        assert!(broken.is_err());
        assert_eq!(taken, 4);
    }
}
