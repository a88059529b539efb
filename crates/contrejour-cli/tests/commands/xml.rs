//! Whether text is well-formed XML, as far as the drawings use it.

use libtest_mimic::Trial;

use crate::{Outcome, cpu_trial};

pub fn trials() -> Vec<Trial> {
    vec![cpu_trial("xml::faults_are_found", faults_are_found)]
}

/// Tags are closed in turn around one root, attributes are quoted, and no `<` or bare `&` stands elsewhere.
pub fn check_well_formed(xml: &str) -> Outcome {
    let mut open = Vec::new();
    let mut roots = 0;
    let mut pieces = xml.trim().split('<');
    if pieces.next() != Some("") {
        return Err("text stands before the root".into());
    }
    for piece in pieces {
        let (tag, text) = piece.split_once('>').ok_or_else(|| format!("<{piece} has no end"))?;
        if let Some(name) = tag.strip_prefix('/') {
            if open.pop() != Some(name) {
                return Err(format!("</{name}> closes nothing"));
            }
        } else {
            let (tag, closes_itself) = tag.strip_suffix('/').map_or((tag, false), |tag| (tag, true));
            let (name, attributes) = tag.split_once(' ').unwrap_or((tag, ""));
            check_attributes(attributes)?;
            roots += u32::from(open.is_empty());
            if !closes_itself {
                open.push(name);
            }
        }
        check_entities(text)?;
    }
    match (&open[..], roots) {
        ([], 1) => Ok(()),
        ([], _) => Err(format!("{roots} roots")),
        ([name, ..], _) => Err(format!("<{name}> is not closed")),
    }
}

fn check_attributes(attributes: &str) -> Outcome {
    let mut rest = attributes.trim();
    while !rest.is_empty() {
        let value = rest.split_once("=\"").filter(|(name, _)| !name.is_empty() && !name.contains([' ', '"']));
        let (value, after) =
            value.and_then(|(_, value)| value.split_once('"')).ok_or_else(|| format!("{rest:?} is no attribute"))?;
        check_entities(value)?;
        rest = after.trim_start();
    }
    Ok(())
}

fn check_entities(text: &str) -> Outcome {
    let known = ["amp;", "lt;", "gt;", "quot;", "apos;"];
    match text.split('&').skip(1).find(|entity| !known.iter().any(|known| entity.starts_with(known))) {
        None => Ok(()),
        Some(entity) => Err(format!("&{entity} is no entity")),
    }
}

fn faults_are_found() -> Outcome {
    check_well_formed("<a b=\"c\" d=\"&lt;\"><e/>f &amp; g<h></h></a>\n")?;
    for faulty in ["", "<a>", "</a>", "<a/><b/>", "<a><b></a></b>", "<a b=c/>", "<a>& b</a>", "<a", "a<b/>"] {
        if check_well_formed(faulty).is_ok() {
            return Err(format!("{faulty:?} passes"));
        }
    }
    Ok(())
}
