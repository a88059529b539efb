//! Families of cases and their names.

use super::case::Case;
use super::effort::Effort;
use super::families::FAMILIES;
use crate::report::Scale;

/// Cases that differ in one thing.
#[derive(Clone, Copy, Debug)]
pub struct Family {
    /// Its name on the command line and in the table.
    pub name: &'static str,
    /// What it stresses, in a sentence.
    pub stresses: &'static str,
    /// What is varied, with its unit: the horizontal axis of its plots.
    pub parameter: &'static str,
    /// How that is spread along the axis.
    pub scale: Scale,
    /// Makes the cases.
    pub cases: fn(&Effort) -> Vec<Case>,
}

/// A name that no family has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no family \"{name}\": give any of {}", FAMILIES.map(|family| family.name).join(", "))]
pub struct UnknownFamily {
    /// The name that was given.
    pub name: String,
}

/// The families with these names, in the order of [`FAMILIES`]; all where no name is given.
///
/// # Errors
///
/// A name that no family has.
pub fn families(names: &[String]) -> Result<Vec<Family>, UnknownFamily> {
    let is_known = |name: &&String| FAMILIES.iter().any(|family| family.name == **name);
    if let Some(name) = names.iter().find(|name| !is_known(name)) {
        return Err(UnknownFamily { name: name.clone() });
    }
    let is_asked = |family: &Family| names.is_empty() || names.iter().any(|name| name == family.name);
    Ok(FAMILIES.into_iter().filter(is_asked).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::Extent;

    #[test]
    fn names_and_parameters_tell_families_and_rows_apart() {
        for (index, family) in FAMILIES.iter().enumerate() {
            assert!(FAMILIES[..index].iter().all(|other| other.name != family.name), "{}", family.name);
            let cases = (family.cases)(&Effort::new(Extent::Quick, 1));
            for (index, case) in cases.iter().enumerate() {
                assert!(
                    cases[..index].iter().all(|other| other.parameter != case.parameter),
                    "{} at {}",
                    family.name,
                    case.parameter
                );
            }
        }
    }

    #[test]
    fn unknown_names_are_told_the_known_ones() {
        let [first, second] = [FAMILIES[0].name, FAMILIES[1].name];
        let asked = families(&[second.to_owned(), first.to_owned()]).expect("both are known");
        assert_eq!(asked.iter().map(|family| family.name).collect::<Vec<_>>(), [first, second]);
        assert_eq!(families(&[]).expect("all").len(), FAMILIES.len());
        let error = families(&["magic".to_owned()]).expect_err("no family").to_string();
        assert!(error.contains("magic") && error.contains(first) && error.contains(second), "{error}");
    }
}
