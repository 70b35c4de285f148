//! Options that take a number.

/// Reads `--NAME N` for each of `names`, in any order, each at most once; those that are not given keep their default.
///
/// # Errors
/// What to write instead.
pub(crate) fn numbers<const N: usize>(
    command: &str,
    names: [(&str, u32); N],
    arguments: &[String],
) -> Result<[u32; N], String> {
    let mut values = names.map(|(_, default)| default);
    let mut given = [false; N];
    let mut words = arguments.iter();
    while let Some(word) = words.next() {
        let (name, value) = match word.split_once('=') {
            Some((name, value)) => (name, Some(value)),
            None => (word.as_str(), words.next().map(String::as_str)),
        };
        let number = value.and_then(|value| value.parse().ok()).filter(|&number| number > 0);
        let place = names.iter().position(|(each, _)| *each == name).filter(|&i| !given[i]);
        let (Some(i), Some(number)) = (place, number) else { return Err(usage(command, &names)) };
        (values[i], given[i]) = (number, true);
    }
    Ok(values)
}

fn usage(command: &str, names: &[(&str, u32)]) -> String {
    let options: Vec<_> = names.iter().map(|(name, _)| format!("`{name} N`")).collect();
    format!("`{command}` takes {}, N a whole number from 1 to 4294967295", options.join(" and "))
}

#[cfg(test)]
mod tests {
    use super::*;

    const NAMES: [(&str, u32); 2] = [("--cases", 7), ("--rounds", 3)];

    fn read(words: &[&str]) -> Result<[u32; 2], String> {
        numbers("soak", NAMES, &words.iter().map(|word| (*word).to_owned()).collect::<Vec<_>>())
    }

    #[test]
    fn right() {
        assert_eq!(read(&[]), Ok([7, 3]), "the defaults");
        assert_eq!(read(&["--cases", "5"]), Ok([5, 3]), "two words");
        assert_eq!(read(&["--rounds=4", "--cases=5"]), Ok([5, 4]), "one word each, in any order");
    }

    #[test]
    fn wrong() {
        let cases = [
            &["--cases"][..],
            &["--cases", "0"],
            &["--cases", "-1"],
            &["--cases=4294967296"],
            &["5"],
            &["--cases", "5", "6"],
            &["--cases=5", "--cases=6"],
            &["--other", "5"],
        ];
        for words in cases {
            let error = read(words).expect_err("it is wrong");
            assert!(error.contains("`--cases N` and `--rounds N`"), "{words:?}: {error}");
        }
    }
}
