// What is counted for each seat, as the stages see it that do not count. Meanings: `SeatCounters` in the layout crate.

struct SeatCounters {
    counts: Counters,
    face_tests: u32,
    edge_tests: u32,
    recheck_words: u32,
    undecided_near: u32,
    undecided_far: u32,
    unused_0: array<u32, 32>,
    unused_1: array<u32, 15>,
}
