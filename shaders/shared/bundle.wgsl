// Views that are tested together. Meanings and units: the structs of the same names in the layout crate.

const MAX_SEATS = 8u;

struct BundleShape {
    seat_count: u32,
    seat_shift: u32,
    caster_stride: u32,
    item_stride: u32,
    silhouette_stride: u32,
    outline_stride: u32,
    unused_0: u32,
    unused_1: u32,
}

struct ViewBundle {
    views: array<LightView, MAX_SEATS>,
    shape: BundleShape,
}

struct TestItem {
    caster: u32,
    block: u32,
    kind: u32,
    seats: u32,
}

// The lit bits of a face lie side by side, one for each seat; a test is the number of such a bit.
fn face_of(test: u32) -> u32 {
    return test >> bundle.shape.seat_shift;
}

fn seat_of(test: u32) -> u32 {
    return test & (bundle.shape.seat_count - 1u);
}

// Where the lit bits of a caster begin, in words.
fn first_lit_word(caster: Caster) -> u32 {
    return caster.first_lit_word << bundle.shape.seat_shift;
}

// The place of a caster among those of all seats.
fn place_of_caster(seat: u32, caster: u32) -> u32 {
    return seat * bundle.shape.caster_stride + caster;
}

fn has_seat(seats: u32, seat: u32) -> bool {
    return (seats >> seat & 1u) == 1u;
}

// The room in the list of undecided faces. The first seat is never empty.
fn undecided_capacity() -> u32 {
    return bundle.views[0].undecided_capacity << bundle.shape.seat_shift;
}
