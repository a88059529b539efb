//! Records on the CPU as they lie in a buffer, of which what changed is written.

use std::ops::Range;

use bytemuck::Pod;

/// Records, and which of them are to be written.
#[derive(Debug)]
pub(crate) struct Records<T> {
    items: Vec<T>,
    /// What is where nothing was put.
    filler: T,
    changed: Vec<Range<usize>>,
}

impl<T: Pod> Records<T> {
    /// None yet; `filler` is what will be where nothing was put.
    pub fn filled_with(filler: T) -> Self {
        Self { items: Vec::new(), filler, changed: Vec::new() }
    }

    pub fn len(&self) -> usize {
        self.items.len()
    }

    /// The records of a range; fewer where it reaches beyond the end.
    pub fn get(&self, range: Range<usize>) -> &[T] {
        let end = range.end.min(self.items.len());
        &self.items[range.start.min(end)..end]
    }

    /// Puts records where they belong.
    pub fn put(&mut self, first: usize, records: impl IntoIterator<Item = T>) {
        let mut end = first;
        for record in records {
            self.items.resize(self.items.len().max(end + 1), self.filler);
            self.items[end] = record;
            end += 1;
        }
        self.changed.push(first..end);
    }

    /// Forgets what is behind the last record that counts.
    pub fn truncate(&mut self, length: usize) {
        self.items.truncate(length);
    }

    /// Lets all be written.
    pub fn change_all(&mut self) {
        self.changed.clear();
        self.changed.push(0..self.items.len());
    }

    /// Hands out what changed, or all, as byte offsets and bytes; records side by side go together.
    pub fn take_changed(&mut self, all: bool, mut write: impl FnMut(u64, &[u8])) {
        if all {
            self.change_all();
        }
        let mut changed = std::mem::take(&mut self.changed);
        changed.sort_unstable_by_key(|range| range.start);
        let mut ranges = changed.into_iter().map(|range| range.start..range.end.min(self.items.len()));
        let mut last = ranges.next().unwrap_or_default();
        let mut put = |range: Range<usize>| {
            let offset = (range.start * size_of::<T>()) as u64;
            write(offset, bytemuck::cast_slice(self.items.get(range).unwrap_or_default()));
        };
        for range in ranges {
            if range.start <= last.end {
                last.end = last.end.max(range.end);
            } else {
                put(std::mem::replace(&mut last, range));
            }
        }
        put(last);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn changed(records: &mut Records<u32>, all: bool) -> Vec<(u64, Vec<u32>)> {
        let mut changed = Vec::new();
        records.take_changed(all, |offset, bytes| changed.push((offset / 4, bytemuck::pod_collect_to_vec(bytes))));
        changed.retain(|(_, records)| !records.is_empty());
        changed
    }

    #[test]
    fn what_changed_is_written_once_and_side_by_side() {
        let mut records = Records::filled_with(9);
        records.put(4, [1, 2]);
        records.put(1, [3]);
        assert_eq!(records.items, [9, 3, 9, 9, 1, 2]);
        records.put(2, [4, 5]);
        records.put(5, [6]);
        assert_eq!(changed(&mut records, false), [(1, vec![3, 4, 5, 1, 6])]);
        assert_eq!(changed(&mut records, false), []);
        records.put(0, [7]);
        records.put(3, [8]);
        assert_eq!(changed(&mut records, false), [(0, vec![7]), (3, vec![8])]);
        assert_eq!(changed(&mut records, true), [(0, vec![7, 3, 4, 8, 1, 6])]);
    }

    #[test]
    fn what_is_behind_the_end_is_not_written() {
        let mut records = Records::filled_with(9);
        records.put(0, [1, 2, 3, 4, 5, 6]);
        records.put(5, []);
        records.truncate(2);
        assert_eq!(changed(&mut records, false), [(0, vec![1, 2])]);
        records.put(4, [7]);
        records.truncate(0);
        assert_eq!(changed(&mut records, false), []);
    }
}
