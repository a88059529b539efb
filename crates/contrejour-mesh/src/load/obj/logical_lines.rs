//! Lines of a text file as their writer meant them.

use std::borrow::Cow;

/// Lines with their number (from 1), without comments and outer white space.
///
/// A line that ends in a backslash goes on with the next one. Line ends are `\n`, `\r\n`, or `\r` alone.
pub(super) struct LogicalLines<'a> {
    rest: &'a str,
    next_line: usize,
}

impl<'a> LogicalLines<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { rest: text.trim_start_matches('\u{feff}'), next_line: 1 }
    }

    fn next_physical(&mut self) -> Option<&'a str> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.find(['\n', '\r']).unwrap_or(self.rest.len());
        let (line, rest) = self.rest.split_at(end);
        self.rest = rest.strip_prefix("\r\n").or_else(|| rest.get(1..)).unwrap_or("");
        self.next_line += 1;
        Some(line)
    }
}

impl<'a> Iterator for LogicalLines<'a> {
    type Item = (usize, Cow<'a, str>);

    fn next(&mut self) -> Option<Self::Item> {
        let number = self.next_line;
        let line = without_comment(self.next_physical()?);
        let Some(start) = line.strip_suffix('\\') else {
            return Some((number, Cow::Borrowed(line)));
        };
        let mut joined = start.to_owned();
        while let Some(line) = self.next_physical() {
            let line = without_comment(line);
            joined.push(' ');
            match line.strip_suffix('\\') {
                Some(part) => joined.push_str(part),
                None => {
                    joined.push_str(line);
                    break;
                }
            }
        }
        Some((number, Cow::Owned(joined)))
    }
}

/// A comment may end in a backslash (a path), which joins nothing.
fn without_comment(line: &str) -> &str {
    line.split('#').next().unwrap_or("").trim()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &str) -> Vec<(usize, String)> {
        LogicalLines::new(text).map(|(number, line)| (number, line.into_owned())).collect()
    }

    #[test]
    fn joined_lines_keep_the_number_of_their_start() {
        let expected = vec![(1, "f 1  2  3".to_owned()), (4, "v 0".to_owned())];
        assert_eq!(lines("f 1 \\\n2 \\\n3\nv 0"), expected);
        assert_eq!(lines("f 1 \\\r\n2 \\\r\n3\r\nv 0\r\n"), expected);
        assert_eq!(lines("f 1 \\\r2 \\\r3\rv 0\r"), expected);
    }

    #[test]
    fn a_comment_joins_nothing() {
        assert_eq!(lines("# C:\\models\\\nv 1"), [(1, String::new()), (2, "v 1".to_owned())]);
    }

    #[test]
    fn a_backslash_at_the_end_of_the_file_is_harmless() {
        assert_eq!(lines("f 1 2 3\\"), [(1, "f 1 2 3".to_owned())]);
    }
}
