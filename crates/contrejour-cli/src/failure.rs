//! Errors as one line.

use std::error::Error;

/// Anything that ends the program.
pub type Failure = Box<dyn Error>;

/// An error and its causes in one line; a cause that is already told is not told again.
pub fn one_line(error: &dyn Error) -> String {
    let mut line = collapsed(&error.to_string());
    let mut cause = error.source();
    while let Some(error) = cause {
        let text = collapsed(&error.to_string());
        if !line.contains(&text) {
            line.push_str(": ");
            line.push_str(&text);
        }
        cause = error.source();
    }
    line
}

fn collapsed(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, thiserror::Error)]
    #[error("outer\n  text")]
    struct Outer(#[source] Inner);

    #[derive(Debug, thiserror::Error)]
    #[error("inner {0}")]
    struct Inner(&'static str, #[source] Innermost);

    #[derive(Debug, thiserror::Error)]
    #[error("text")]
    struct Innermost;

    #[test]
    fn a_chain_is_one_line_without_repetition() {
        assert_eq!(one_line(&Outer(Inner("cause", Innermost))), "outer text: inner cause");
    }
}
