// Appending to a list of each seat with one global atomic for each workgroup and seat.
//
// Use, in uniform control flow: each lane counts with `seat_counts`; after a barrier lane `seat` adds that to the global
// counter and puts what it got into `seat_places`; after another one each lane takes places from there.

var<workgroup> seat_counts: array<atomic<u32>, MAX_SEATS>;
var<workgroup> seat_places: array<atomic<u32>, MAX_SEATS>;

fn count_for_seats(seats: u32) {
    for (var seat = 0u; seat < bundle.shape.seat_count; seat++) {
        if has_seat(seats, seat) {
            atomicAdd(&seat_counts[seat], 1u);
        }
    }
}
