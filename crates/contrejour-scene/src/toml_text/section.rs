//! A TOML document and its sections.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::value::Value;
use crate::{Place, Problem, SceneError};

/// The text that spans refer to.
#[derive(Clone, Copy)]
pub(super) struct Document<'t> {
    pub file_name: &'t str,
    pub text: &'t str,
}

impl Document<'_> {
    /// The error that `problem` at the start of `span` is.
    pub fn refuse(&self, span: Range<usize>, problem: Problem) -> SceneError {
        // A span can end past the text, or within a character where the text breaks off.
        let before = self.text.get(..span.start).unwrap_or(self.text);
        let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
        let place = Place {
            file: self.file_name.to_owned(),
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
        };
        SceneError::InFile { place, problem: Box::new(problem) }
    }

    /// The error that the TOML parser found.
    pub fn refuse_syntax(&self, error: &toml::de::Error) -> SceneError {
        let end = self.text.len()..self.text.len();
        let span = error.span().unwrap_or(end);
        let mut message = error.message().replace('\n', ", ");
        if message.contains("duplicate key")
            && let Some(list) = self.list_headed_at(span.start)
        {
            message += &format!("; where there are several, each begins with `[[{list}]]`, and none with `[{list}]`");
        }
        self.refuse(span, Problem::Syntax(message))
    }

    /// The list whose header stands in the line of a place.
    fn list_headed_at(&self, at: usize) -> Option<&'static str> {
        let begin = self.text[..at].rfind('\n').map_or(0, |end| end + 1);
        let line = self.text[begin..].lines().next()?.trim_start();
        let name = line.strip_prefix('[')?.trim_start_matches('[').split(']').next()?.trim();
        LISTS.into_iter().find(|list| *list == name)
    }
}

/// What a scene may have several of.
const LISTS: [&str; 2] = ["light", "mesh"];

/// A table of which all keys are known.
#[derive(Clone)]
pub(super) struct Section<'t> {
    pub document: Document<'t>,
    name: String,
    span: Range<usize>,
    table: &'t DeTable<'t>,
}

impl<'t> Section<'t> {
    /// The section, unless it has a key that is not in `known`.
    pub fn new(
        document: Document<'t>,
        name: &str,
        span: Range<usize>,
        table: &'t DeTable<'t>,
        known: &'static [&'static str],
    ) -> Result<Self, SceneError> {
        let stray = table.keys().filter(|key| !known.contains(&key.get_ref().as_ref()));
        // The table is sorted by name; the first stray key in the text is the one to name.
        if let Some(key) = stray.min_by_key(|key| key.span().start) {
            let problem = Problem::UnknownKey { key: key.get_ref().to_string(), section: name.to_owned(), known };
            return Err(document.refuse(key.span(), problem));
        }
        Ok(Self { document, name: name.to_owned(), span, table })
    }

    /// The value of `key`, if it is there.
    pub fn get(&self, key: &str) -> Option<Value<'t>> {
        let spanned: &'t Spanned<DeValue<'t>> = self.table.get(key)?;
        Some(Value { document: self.document, key: key.to_owned(), spanned })
    }

    /// The value of `key`, which must be there.
    pub fn require(&self, key: &'static str) -> Result<Value<'t>, SceneError> {
        self.get(key).ok_or_else(|| self.refuse(Problem::MissingKey { key, section: self.name.clone() }))
    }

    /// What `read` makes of the value of `key`, or `default` where there is none.
    pub fn read_or<T>(
        &self,
        key: &str,
        default: T,
        read: impl FnOnce(&Value<'t>) -> Result<T, SceneError>,
    ) -> Result<T, SceneError> {
        self.get(key).map_or(Ok(default), |value| read(&value))
    }

    /// The error that `problem` with the section is.
    pub fn refuse(&self, problem: Problem) -> SceneError {
        self.document.refuse(self.span.clone(), problem)
    }

    /// The error that `problem` with `key` is, or with the section where the key is not there.
    pub fn refuse_key(&self, key: &str, problem: Problem) -> SceneError {
        match self.get(key) {
            Some(value) => value.refuse(problem),
            None => self.refuse(problem),
        }
    }
}
