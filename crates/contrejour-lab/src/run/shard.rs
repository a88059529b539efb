//! A part of a run, for one of several machines.

use core::fmt;
use core::str::FromStr;

/// Which part of a run is done: every `of`-th piece of work, from the `number`-th on; none where there are fewer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    number: usize,
    of: usize,
}

/// Text that names no shard.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{text:?} is no shard; give its number and how many there are, as in 1/4 up to 4/4")]
pub struct NoShard {
    /// The text.
    pub text: String,
}

impl Shard {
    /// All of the work.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// A part of the work; none where `number` is not from 1 to `of`.
    pub fn new(number: usize, of: usize) -> Option<Self> {
        (1..=of).contains(&number).then_some(Self { number, of })
    }

    /// Its number. Range: 1 to [`of`](Self::of).
    pub fn number(self) -> usize {
        self.number
    }

    /// How many there are.
    pub fn of(self) -> usize {
        self.of
    }

    /// Whether it does a piece of work, by the piece's index: they are dealt like cards.
    pub fn does(self, index: usize) -> bool {
        index % self.of == self.number - 1
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Shard {
    type Err = NoShard;

    fn from_str(text: &str) -> Result<Self, NoShard> {
        let number = |text: &str| text.trim().parse().ok();
        (text.split_once('/'))
            .and_then(|(shard, of)| Self::new(number(shard)?, number(of)?))
            .ok_or_else(|| NoShard { text: text.to_owned() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_piece_is_done_once() {
        for of in 1..=7 {
            for index in 0..24 {
                let doing = (1..=of).filter_map(|number| Shard::new(number, of)).filter(|shard| shard.does(index));
                assert_eq!(doing.count(), 1, "piece {index} of {of} shards");
            }
        }
        assert!((0..24).all(|index| Shard::WHOLE.does(index)));
    }

    #[test]
    fn text_comes_back_and_other_text_is_refused() {
        assert_eq!("2/3".parse(), Shard::new(2, 3).ok_or(NoShard { text: String::new() }));
        assert_eq!(Shard::new(2, 3).map(|shard| shard.to_string()).as_deref(), Some("2/3"));
        for text in ["0/3", "4/3", "1/0", "1", "a/b", "-1/2", ""] {
            assert_eq!(text.parse::<Shard>(), Err(NoShard { text: text.into() }));
        }
    }
}
