//! One TOML value and what may be made of it.

use toml::Spanned;
use toml::de::DeValue;

use super::section::{Document, Section};
use crate::{Problem, Scene, SceneError};

/// The largest number that a scene may have: its square still counts in `f32`.
pub(super) const LARGEST: f64 = 1e15;

/// Which numbers are accepted, and how that is said.
#[derive(Clone, Copy)]
pub(super) struct Accepts {
    test: fn(f64) -> bool,
    says: &'static str,
}

/// Any number up to [`LARGEST`].
pub(super) const ANY: Accepts = Accepts { test: |_| true, says: "a number between -1e15 and 1e15" };
/// Numbers above zero.
pub(super) const POSITIVE: Accepts =
    Accepts { test: |value| value > 1e-15, says: "a number above 1e-15 and up to 1e15" };
/// Zero and up.
pub(super) const NOT_NEGATIVE: Accepts = Accepts { test: |value| value >= 0.0, says: "a number from 0 to 1e15" };
/// Anything but zero.
pub(super) const NOT_ZERO: Accepts =
    Accepts { test: |value| value.abs() > 1e-15, says: "a number between -1e15 and 1e15 and not within 1e-15 of 0" };
/// Shares.
pub(super) const SHARE: Accepts = Accepts { test: |value| (0.0..=1.0).contains(&value), says: "a number from 0 to 1" };
/// Shares of up to a half.
pub(super) const HALF_SHARE: Accepts =
    Accepts { test: |value| (0.0..=0.5).contains(&value), says: "a number from 0 to 0.5" };
/// Multiples of up to a thousand.
pub(super) const UP_TO_A_THOUSAND: Accepts =
    Accepts { test: |value| (0.0..=1000.0).contains(&value), says: "a number from 0 to 1000" };
/// How many cascades there may be.
pub(super) const CASCADES: Accepts =
    Accepts { test: |value| (1.0..=8.0).contains(&value) && value.fract() == 0.0, says: "a whole number from 1 to 8" };
/// Opening angles, in degrees.
pub(super) const OPENING: Accepts =
    Accepts { test: |value| (0.01..=179.0).contains(&value), says: "degrees from 0.01 to 179" };
/// Angular radii, in degrees.
pub(super) const ANGULAR_RADIUS: Accepts =
    Accepts { test: |value| (0.0..90.0).contains(&value), says: "degrees from 0 to less than 90" };

/// Exposure values.
pub(super) const EXPOSURE: Accepts =
    Accepts { test: |value| value.abs() <= Scene::MAX_EXPOSURE_EV100, says: "an exposure value from -64 to 64" };

/// A value and the key it belongs to.
#[derive(Clone)]
pub(super) struct Value<'t> {
    pub document: Document<'t>,
    pub key: String,
    pub spanned: &'t Spanned<DeValue<'t>>,
}

impl<'t> Value<'t> {
    /// A number, given as a float or an integer.
    pub fn number(&self, accepts: Accepts) -> Result<f64, SceneError> {
        let value = match self.spanned.get_ref() {
            DeValue::Float(float) => float.as_str().parse::<f64>().ok(),
            DeValue::Integer(integer) => {
                i64::from_str_radix(integer.as_str(), integer.radix()).ok().map(|value| value as f64)
            }
            _ => return Err(self.wrong_type(accepts.says)),
        };
        match value {
            Some(number) if number.abs() <= LARGEST && (accepts.test)(number) => Ok(number),
            _ => Err(self.out_of_range(accepts.says)),
        }
    }

    /// A whole number that fits `u32`.
    pub fn count(&self) -> Result<u32, SceneError> {
        const SAYS: &str = "a whole number from 0 to 4294967295";
        match self.spanned.get_ref() {
            DeValue::Integer(integer) => {
                u32::from_str_radix(integer.as_str(), integer.radix()).map_err(|_| self.out_of_range(SAYS))
            }
            _ => Err(self.wrong_type(SAYS)),
        }
    }

    /// A string.
    pub fn text(&self) -> Result<&'t str, SceneError> {
        self.spanned.get_ref().as_str().ok_or_else(|| self.wrong_type("a string in quotes"))
    }

    /// `true` or `false`.
    pub fn flag(&self) -> Result<bool, SceneError> {
        self.spanned.get_ref().as_bool().ok_or_else(|| self.wrong_type("true or false"))
    }

    /// An array of exactly `N` numbers.
    pub fn numbers<const N: usize>(&self, accepts: Accepts) -> Result<[f64; N], SceneError> {
        let mut numbers = [0.0; N];
        for (number, item) in numbers.iter_mut().zip(self.items::<N>("numbers")?) {
            *number = item.number(accepts)?;
        }
        Ok(numbers)
    }

    /// Whether it is an array.
    pub fn is_array(&self) -> bool {
        self.spanned.get_ref().is_array()
    }

    /// A linear colour.
    pub fn color(&self, accepts: Accepts) -> Result<[f32; 3], SceneError> {
        Ok(self.numbers(accepts)?.map(|channel: f64| channel as f32))
    }

    /// The items of an array of exactly `N`.
    pub fn items<const N: usize>(&self, what: &str) -> Result<[Self; N], SceneError> {
        let expected = format!("an array of {N} {what}");
        let array = self.spanned.get_ref().as_array().ok_or_else(|| self.wrong_type(&expected))?;
        let items: Vec<Self> = array.iter().map(|item| self.item(item)).collect();
        let found = items.len();
        items.try_into().map_err(|_| {
            let value = format!("an array of {found}");
            self.refuse(Problem::OutOfRange { key: self.key.clone(), value, expected })
        })
    }

    /// A table of which all keys are in `known`.
    pub fn section(&self, name: &str, known: &'static [&'static str]) -> Result<Section<'t>, SceneError> {
        let table = self.spanned.get_ref().as_table().ok_or_else(|| self.wrong_type("a table"))?;
        Section::new(self.document, name, self.spanned.span(), table, known)
    }

    /// An array of tables of which all keys are in `known`.
    pub fn sections(&self, name: &str, known: &'static [&'static str]) -> Result<Vec<Section<'t>>, SceneError> {
        self.tables()?.iter().map(|item| item.section(name, known)).collect()
    }

    /// The items of an array of tables.
    pub fn tables(&self) -> Result<Vec<Self>, SceneError> {
        let array = self.spanned.get_ref().as_array().ok_or_else(|| self.wrong_type("an array of tables"))?;
        Ok(array.iter().map(|item| self.item(item)).collect())
    }

    /// Which of the `known` names it is, as an index.
    pub fn name_of(&self, known: &'static [&'static str]) -> Result<usize, SceneError> {
        let name = self.text()?;
        known
            .iter()
            .position(|candidate| *candidate == name)
            .ok_or_else(|| self.refuse(Problem::UnknownName { key: self.key.clone(), name: name.to_owned(), known }))
    }

    /// The error that `problem` with this value is.
    pub fn refuse(&self, problem: Problem) -> SceneError {
        self.document.refuse(self.spanned.span(), problem)
    }

    fn item(&self, spanned: &'t Spanned<DeValue<'t>>) -> Self {
        Self { document: self.document, key: self.key.clone(), spanned }
    }

    fn wrong_type(&self, expected: &str) -> SceneError {
        let found = match self.spanned.get_ref() {
            DeValue::String(_) => "a string",
            DeValue::Integer(_) => "a whole number",
            DeValue::Float(_) => "a number",
            DeValue::Boolean(_) => "true or false",
            DeValue::Datetime(_) => "a date",
            DeValue::Array(_) => "an array",
            DeValue::Table(_) => "a table",
        };
        self.refuse(Problem::WrongType { key: self.key.clone(), expected: expected.to_owned(), found })
    }

    fn out_of_range(&self, expected: &str) -> SceneError {
        let value = self.document.text.get(self.spanned.span()).unwrap_or("a number").to_owned();
        self.refuse(Problem::OutOfRange { key: self.key.clone(), value, expected: expected.to_owned() })
    }
}
