//! Words for error messages: quoting what the file says, and guessing what it meant.

/// Longest piece of the file that a message repeats, in characters.
const SHOWN: usize = 60;

/// The text with control characters escaped, so that it stays on one line and says nothing to the
/// terminal.
pub(crate) fn one_line(text: &str) -> String {
    let mut line = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_control()
            || matches!(c, '\u{2028}' | '\u{2029}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
        {
            line.extend(c.escape_default());
        } else {
            line.push(c);
        }
    }
    line
}

/// What the file says, in quotes, escaped and cut to a readable length.
pub(crate) fn quoted(text: &str) -> String {
    format!("\"{}\"", shortened(text))
}

/// What the file says, escaped and cut to a readable length.
pub(crate) fn shortened(text: &str) -> String {
    let mut chars = text.chars();
    let head: String = chars.by_ref().take(SHOWN).collect();
    one_line(&head) + if chars.next().is_some() { "…" } else { "" }
}

/// Longest file name that a message repeats, in characters: no file system allows a longer one.
const NAME_SHOWN: usize = 255;

/// A path in quotes, escaped and cut to a readable length as by [`shortened_path`].
pub(crate) fn quoted_path(path: &str) -> String {
    format!("\"{}\"", shortened_path(path))
}

/// A path, escaped and cut to a readable length in its middle, so that its beginning and the file's name stay.
pub(crate) fn shortened_path(path: &str) -> String {
    let whole = one_line(path);
    let length = whole.chars().count();
    if length <= SHOWN {
        return whole;
    }
    let name = whole.rsplit(['/', '\\']).next().unwrap_or_default().chars().count();
    // A third for where it begins, the rest for where it ends; more only if the name is longer.
    let head = SHOWN / 3;
    let tail = (SHOWN - head).max(name + 1).min(NAME_SHOWN + 1);
    if head + tail >= length {
        return whole;
    }
    let start: String = whole.chars().take(head).collect();
    let end: String = whole.chars().skip(length - tail).collect();
    format!("{start}…{end}")
}

/// "a, b or c".
pub(crate) fn any_of<S: AsRef<str>>(words: &[S]) -> String {
    joined(words, "or")
}

/// "a, b and c".
pub(crate) fn all_of<S: AsRef<str>>(words: &[S]) -> String {
    joined(words, "and")
}

fn joined<S: AsRef<str>>(words: &[S], last: &str) -> String {
    match words {
        [] => String::new(),
        [one] => one.as_ref().to_owned(),
        [head @ .., tail] => {
            let head: Vec<&str> = head.iter().map(AsRef::as_ref).collect();
            format!("{} {last} {}", head.join(", "), tail.as_ref())
        }
    }
}

/// The valid word that `word` was probably meant to be: the nearest one, if at most a third of it
/// (and at least one letter) is different.
pub(crate) fn nearest<'a>(word: &str, valid: &[&'a str]) -> Option<&'a str> {
    let word: String = word.chars().take(SHOWN).collect::<String>().to_lowercase();
    valid
        .iter()
        .map(|v| (strsim::osa_distance(&word, v), *v))
        .filter(|(distance, v)| *distance <= (v.len() / 3).max(1))
        .min_by_key(|(distance, _)| *distance)
        .map(|(_, v)| v)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_words_are_found_and_far_ones_are_not() {
        let keys = ["position", "radius", "width", "height", "up"];
        for (typed, meant) in [
            ("postion", "position"),
            ("radius ", "radius"),
            ("Width", "width"),
            ("hieght", "height"),
            ("pu", "up"),
        ] {
            assert_eq!(nearest(typed, &keys), Some(meant), "{typed}");
        }
        for typed in ["", "colour", "xyz", "positioning system"] {
            assert_eq!(nearest(typed, &keys), None, "{typed}");
        }
    }

    #[test]
    fn long_paths_keep_the_file_s_name() {
        assert_eq!(quoted_path("meshes/a\n.obj"), "\"meshes/a\\n.obj\"", "short, and escaped");
        let deep = format!("/home/someone/{}/meshes/the one.obj", "folder/".repeat(40));
        let shown = shortened_path(&deep);
        assert_eq!(shown.chars().count(), SHOWN + 1, "{shown} has an ellipsis too");
        assert!(shown.starts_with("/home/someone/") && shown.ends_with("/meshes/the one.obj"), "{shown}");
        let name = format!("{}.obj", "x".repeat(200));
        for separator in ["/", "\\"] {
            let shown = shortened_path(&format!("{}{separator}{name}", "y".repeat(99)));
            assert!(shown.ends_with(&format!("…{separator}{name}")), "{shown}");
        }
        let absurd = shortened_path(&"z".repeat(100_000));
        assert!(absurd.chars().count() < 300, "{absurd}");
    }

    #[test]
    fn long_and_odd_text_is_cut_and_escaped() {
        assert_eq!(quoted("a\"b\u{7}"), "\"a\"b\\u{7}\"", "control characters are escaped");
        assert_eq!(quoted(&"x".repeat(1000)).chars().count(), SHOWN + 3, "two quotes and an ellipsis");
        assert_eq!(any_of(&["a", "b", "c"]), "a, b or c", "a list");
        assert_eq!(all_of(&["a", "b"]), "a and b", "a list");
        assert_eq!(all_of::<&str>(&[]), "", "no list");
    }
}
