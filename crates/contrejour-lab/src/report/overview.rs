//! Which scenes and sizes a report has, and which size stands for a scene.

use super::{Contestant, Group, Report};

/// The size that most readers use; the one nearest to it stands for a scene.
const USUAL_MAP_SIZE: u32 = 1024;

impl Report {
    /// Names of the scenes, in the order of their first groups.
    pub fn scenes(&self) -> Vec<&str> {
        first_of_each(self.groups.iter().map(|group| group.scene.as_str()))
    }

    /// The groups of a scene, in order.
    pub fn groups_of(&self, scene: &str) -> impl Iterator<Item = &Group> {
        self.groups.iter().filter(move |group| group.scene == scene)
    }

    /// The group that stands for a scene: its map size is nearest to 1024, of equally near ones the larger.
    pub fn headline_of(&self, scene: &str) -> Option<&Group> {
        let distance = |group: &&Group| {
            (f64::from(group.map_size) / f64::from(USUAL_MAP_SIZE)).log2().abs() - f64::from(group.map_size) * 1e-12
        };
        self.groups_of(scene).min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// Names of the families, in the order of their first contestants.
    pub fn families(&self) -> Vec<&str> {
        let contestants = self.groups.iter().flat_map(|group| &group.contestants);
        first_of_each(contestants.map(|contestant| contestant.family.as_str()))
    }
}

impl Group {
    /// The contestant that stands for a family.
    pub fn standing_for(&self, family: &str) -> Option<&Contestant> {
        self.standing().find(|contestant| contestant.family == family)
    }
}

fn first_of_each<'a>(names: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut first = Vec::new();
    for name in names {
        if !first.contains(&name) {
            first.push(name);
        }
    }
    first
}

#[cfg(test)]
mod tests {
    use super::super::sample;

    #[test]
    fn the_size_nearest_to_1024_stands_for_its_scene() {
        let sizes =
            |scene, sizes: &[u32]| sizes.iter().map(|&size| sample::group(scene, size, vec![])).collect::<Vec<_>>();
        let groups =
            [sizes("all", &[256, 512, 1024, 2048]), sizes("around", &[512, 2048]), sizes("small", &[256, 512])];
        let report = sample::report(groups.concat());
        assert_eq!(report.scenes(), ["all", "around", "small"]);
        let headlines = report.scenes().into_iter().filter_map(|scene| report.headline_of(scene));
        assert_eq!(headlines.map(|group| group.map_size).collect::<Vec<_>>(), [1024, 2048, 512]);
        assert_eq!(report.headline_of("none"), None);
    }

    #[test]
    fn families_are_named_once() {
        let contestant = |family| sample::contestant(family, family, family, 0.1, 1.0);
        let report = sample::report(vec![
            sample::group("a", 512, vec![contestant("plain"), contestant("pcss"), contestant("pcss")]),
            sample::group("b", 512, vec![contestant("smoothies"), contestant("plain")]),
        ]);
        assert_eq!(report.families(), ["plain", "pcss", "smoothies"]);
        assert!(report.groups[0].standing_for("smoothies").is_none());
        assert!(report.groups[1].standing_for("smoothies").is_some());
    }
}
