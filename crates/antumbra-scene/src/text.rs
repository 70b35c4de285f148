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
    fn long_and_odd_text_is_cut_and_escaped() {
        assert_eq!(quoted("a\"b\u{7}"), "\"a\"b\\u{7}\"", "control characters are escaped");
        assert_eq!(quoted(&"x".repeat(1000)).chars().count(), SHOWN + 3, "two quotes and an ellipsis");
        assert_eq!(any_of(&["a", "b", "c"]), "a, b or c", "a list");
        assert_eq!(all_of(&["a", "b"]), "a and b", "a list");
        assert_eq!(all_of::<&str>(&[]), "", "no list");
    }
}
