// What is counted for each seat, as the stages see it that count. Meanings: `SeatCounters` in the layout crate.

struct AtomicSeatCounters {
    counts: AtomicCounters,
    face_tests: atomic<u32>,
    edge_tests: atomic<u32>,
    recheck_words: atomic<u32>,
    undecided_near: atomic<u32>,
    undecided_far: atomic<u32>,
    unused_0: array<u32, 32>,
    unused_1: array<u32, 15>,
}
