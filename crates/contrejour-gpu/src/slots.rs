//! Things that come and go behind handles. What stays keeps its place; places are used again.

/// Names a thing for as long as it is there: a place that is used again has another generation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Key {
    pub slot: usize,
    generation: u32,
}

#[derive(Debug)]
pub(crate) struct Slots<T> {
    slots: Vec<Slot<T>>,
    free: Vec<usize>,
}

#[derive(Debug)]
struct Slot<T> {
    generation: u32,
    item: Option<T>,
}

impl<T> Default for Slots<T> {
    fn default() -> Self {
        Self { slots: Vec::new(), free: Vec::new() }
    }
}

impl<T> Slots<T> {
    pub fn insert(&mut self, item: T) -> Key {
        let slot = self.free.pop().unwrap_or_else(|| {
            self.slots.push(Slot { generation: 0, item: None });
            self.slots.len() - 1
        });
        self.slots[slot].item = Some(item);
        Key { slot, generation: self.slots[slot].generation }
    }

    pub fn remove(&mut self, key: Key) -> Option<T> {
        let slot = self.slots.get_mut(key.slot).filter(|slot| slot.generation == key.generation)?;
        let item = slot.item.take()?;
        slot.generation += 1;
        self.free.push(key.slot);
        Some(item)
    }

    pub fn get(&self, key: Key) -> Option<&T> {
        self.slots.get(key.slot).filter(|slot| slot.generation == key.generation)?.item.as_ref()
    }

    pub fn get_mut(&mut self, key: Key) -> Option<&mut T> {
        self.slots.get_mut(key.slot).filter(|slot| slot.generation == key.generation)?.item.as_mut()
    }

    /// What is there, with its place, by ascending place.
    pub fn iter(&self) -> impl Iterator<Item = (usize, &T)> {
        self.slots.iter().enumerate().filter_map(|(slot, entry)| Some((slot, entry.item.as_ref()?)))
    }

    /// What is there, with its key, by ascending place.
    pub fn iter_mut(&mut self) -> impl Iterator<Item = (Key, &mut T)> {
        self.slots.iter_mut().enumerate().filter_map(|(slot, entry)| {
            let key = Key { slot, generation: entry.generation };
            Some((key, entry.item.as_mut()?))
        })
    }

    /// Whatever is at a place.
    pub fn at(&self, slot: usize) -> Option<&T> {
        self.slots.get(slot)?.item.as_ref()
    }

    pub fn at_mut(&mut self, slot: usize) -> Option<&mut T> {
        self.slots.get_mut(slot)?.item.as_mut()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stays_keeps_its_place() {
        let mut slots = Slots::default();
        let keys = [10, 11, 12].map(|item| slots.insert(item));
        assert_eq!(slots.remove(keys[1]), Some(11));
        assert_eq!(slots.iter().collect::<Vec<_>>(), [(0, &10), (2, &12)]);
        assert_eq!((slots.get(keys[2]), slots.at(1)), (Some(&12), None));
    }

    #[test]
    fn places_are_used_again_and_old_keys_name_nothing() {
        let mut slots = Slots::default();
        let old = slots.insert(1);
        slots.remove(old);
        let new = slots.insert(2);
        assert_eq!(new.slot, old.slot);
        assert_eq!(slots.get_mut(old), None);
        assert_eq!((slots.get(old), slots.get(new)), (None, Some(&2)));
        assert_eq!((slots.remove(old), slots.remove(new), slots.remove(new)), (None, Some(2), None));
    }

    #[test]
    fn thousands_that_come_and_go_fill_few_places() {
        let mut slots = Slots::default();
        let mut keys = std::collections::VecDeque::new();
        for item in 0..10_000 {
            keys.push_back(slots.insert(item));
            if keys.len() > 20 {
                keys.pop_front().and_then(|key| slots.remove(key)).expect("it is there");
            }
        }
        assert!(slots.slots.len() <= 21);
        assert_eq!(slots.iter().count(), 20);
    }
}
