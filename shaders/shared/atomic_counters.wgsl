// The counters as the stages see them that count. Meanings: `Counters` in the layout crate.

struct AtomicCounters {
    undecided_near: atomic<u32>,
    undecided_far: atomic<u32>,
    silhouette_edges: atomic<u32>,
    quads: atomic<u32>,
    corners: atomic<u32>,
    point_edges: atomic<u32>,
    recheck_words: atomic<u32>,
    face_items: atomic<u32>,
    edge_items: atomic<u32>,
    casters: atomic<u32>,
    imageless_casters: atomic<u32>,
    masked_items: atomic<u32>,
}
