//! From visibilities to a page: a made-up run through metrics, model, files and HTML.
//!
//! The page stays in the target folder (`tmp/sample-report/index.html`) to be looked at.

mod made_up;

use std::path::PathBuf;

use contrejour_lab::report::{PAGE_FILE, Report};

/// Each test has a folder of its own, since they run at the same time.
fn folder(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name)
}

fn page(name: &str) -> (Report, String) {
    let folder = folder(name);
    let report = made_up::report(&folder);
    report.write(&folder).expect("the report can be written");
    let page = std::fs::read_to_string(folder.join(PAGE_FILE)).expect("it was just written");
    (report, page)
}

#[test]
fn the_page_needs_nothing_but_itself() {
    let (_, page) = page("sample-report");
    for forbidden in ["<script", "<link", "@import", "src=\"http", "url("] {
        assert!(!page.contains(forbidden), "the page has {forbidden}");
    }
    let sources = page.match_indices(" src=\"").map(|(at, text)| &page[at + text.len()..]);
    assert!(sources.clone().count() > 10);
    for source in sources {
        assert!(source.starts_with("data:image/png;base64,"), "{}", &source[..40]);
    }
}

#[test]
fn the_page_holds_what_was_measured() {
    let (report, page) = page("sample-report-parts");
    for scene in report.scenes() {
        assert!(page.contains(scene), "{scene}");
    }
    for family in report.families() {
        assert!(page.contains(family), "{family}");
    }
    for part in ["findings", "glance", "time", "pictures", "stages", "sweeps", "papers", "method"] {
        assert!(page.contains(&format!("<section id=\"{part}\">")), "{part}");
    }
    // What a reader who can't see needs.
    assert_eq!(page.matches("<img").count(), page.matches(" alt=\"").count());
    assert!(!page.contains("alt=\"\""));
    assert_eq!(page.matches("<table").count(), page.matches("<caption").count());
}

#[test]
fn names_are_escaped() {
    let folder = folder("sample-report-escaped");
    let mut report = made_up::report(&folder);
    report.header.command = "contrejour report <b>&</b>".into();
    let page = report.to_page(&folder).expect("there is a page");
    assert!(page.contains("contrejour report &lt;b&gt;&amp;&lt;/b&gt;") && !page.contains("<b>"));
}

#[test]
fn two_runs_give_the_same_page() {
    assert_eq!(page("sample-report-first").1, page("sample-report-second").1);
}
