//! Small changes to bytes.

use proptest::prelude::*;

/// Numbers that lengths and counts break at, and pieces of text that change what follows.
const PIECES: &[&[u8]] = &[
    &[0],
    &[0xff; 4],
    &[0, 0, 0, 0x80],
    &[0xff, 0xff, 0xff, 0x7f],
    b"\n",
    b"\r\n",
    b"\\\n",
    b" ",
    b"-",
    b"-1",
    b"0",
    b"4294967296",
    b"18446744073709551615",
    b"1e39",
    b"1e-46",
    b"nan",
    b"inf",
    b"\"",
    b"{",
    b"[",
    b"]}",
    b"\xc3\xa9",
    b"missing",
];

/// One change, at a share of the length.
#[derive(Clone, Debug)]
pub enum Mutation {
    /// Another byte.
    Byte(f64, u8),
    /// A piece more.
    Insert(f64, &'static [u8]),
    /// A piece in place of what is there.
    Overwrite(f64, &'static [u8]),
    /// A part less.
    Remove(f64, usize),
    /// A part again, from elsewhere.
    Copy(f64, f64, usize),
    /// Nothing after here.
    Cut(f64),
}

/// A few changes.
pub fn mutations() -> impl Strategy<Value = Vec<Mutation>> {
    let share = || 0.0..1.0_f64;
    let piece = || prop::sample::select(PIECES);
    let mutation = prop_oneof![
        (share(), any::<u8>()).prop_map(|(at, byte)| Mutation::Byte(at, byte)),
        (share(), piece()).prop_map(|(at, piece)| Mutation::Insert(at, piece)),
        (share(), piece()).prop_map(|(at, piece)| Mutation::Overwrite(at, piece)),
        (share(), 1..40_usize).prop_map(|(at, length)| Mutation::Remove(at, length)),
        (share(), share(), 1..80_usize).prop_map(|(from, to, length)| Mutation::Copy(from, to, length)),
        share().prop_map(Mutation::Cut),
    ];
    prop::collection::vec(mutation, 1..5)
}

/// The bytes with all changes.
pub fn mutate(seed: &[u8], mutations: &[Mutation]) -> Vec<u8> {
    let mut bytes = seed.to_vec();
    for mutation in mutations {
        let place = |share: f64| (share * bytes.len() as f64) as usize;
        let part = |share: f64, length: usize| place(share)..bytes.len().min(place(share) + length);
        match *mutation {
            Mutation::Byte(at, byte) => {
                let range = part(at, 1);
                bytes.splice(range, [byte]);
            }
            Mutation::Insert(at, piece) => {
                let at = place(at);
                bytes.splice(at..at, piece.iter().copied());
            }
            Mutation::Overwrite(at, piece) => {
                let range = part(at, piece.len());
                bytes.splice(range, piece.iter().copied());
            }
            Mutation::Remove(at, length) => drop(bytes.drain(part(at, length))),
            Mutation::Copy(from, to, length) => {
                let (to, copy) = (place(to), bytes[part(from, length)].to_vec());
                bytes.splice(to..to, copy);
            }
            Mutation::Cut(at) => bytes.truncate(place(at)),
        }
    }
    bytes
}
