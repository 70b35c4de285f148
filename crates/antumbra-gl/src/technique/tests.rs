//! The list of techniques, and their names and options as text.

use super::*;
use crate::input::Allowed;

#[test]
fn every_technique_reads_what_it_writes() {
    assert_eq!(Technique::all().count(), Technique::NAMES.len(), "one a name");
    for (technique, name) in Technique::all().zip(Technique::NAMES) {
        assert_eq!(technique.name(), *name, "in the order of their names");
        assert_eq!(technique.to_string(), technique.name(), "defaults are not written");
        assert_eq!(Technique::parse(technique.name()), Ok(technique), "the name alone");
        let about = technique.about();
        assert!(!about.summary.is_empty() && !about.casts_from.is_empty(), "{technique} says what it is");
    }
}

#[test]
fn every_technique_has_a_theory_page() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/theory");
    for name in Technique::NAMES {
        let page = folder.join(name).with_extension("md");
        assert!(page.is_file(), "{} is missing", page.display());
    }
}

#[test]
fn mistakes_say_what_to_write() {
    let of = |text: &str| Technique::parse(text).expect_err(text).to_string();
    assert_eq!(
        of("analitic"),
        format!("there is no technique `analitic`; the techniques are {}", Technique::NAMES.join(", ")),
        "a typing mistake"
    );
    assert!(of("").contains("the techniques are"), "nothing at all");
    assert!(of("analytic:size=3").contains("there is no option `size=3`"), "{}", of("analytic:size=3"));
    assert!(of("analytic:").contains("there is no option"), "{}", of("analytic:"));
}

#[test]
fn techniques_say_how_they_behave() {
    let of = |text: &str| {
        let technique = Technique::parse(text).expect(text);
        (technique.paints(), technique.components(), technique.is_exact())
    };
    assert_eq!(of("composite:components=5"), (true, Some(5), false), "paints, areas as points");
    assert_eq!(of("composite:shade=physical"), (false, None, false), "refuses areas");
    assert_eq!(of("projected:shade=paper"), (true, None, false), "paints");
    assert_eq!(of("analytic:quality=exact"), (false, None, true), "several occluders at once");
    for ordinary in ["analytic", "projected", "volume", "map"] {
        assert_eq!(of(ordinary), (false, None, false), "{ordinary}");
    }
}

/// Texts that an option can be set to, and texts that it cannot, from what it says of itself.
fn right_and_wrong(allowed: Allowed) -> (Vec<String>, Vec<String>) {
    let text = |x: f64| x.to_string();
    match allowed {
        Allowed::Number { low, high, whole } => {
            assert!(low < high && high.is_finite(), "{low} to {high}");
            let middle = if whole { (0.5 * (low + high)).round() } else { 0.5 * (low + high) };
            let wrong = [low - 1.0, high + 1.0, f64::NAN, f64::INFINITY].map(text);
            let wrong = wrong.into_iter().chain(whole.then(|| text(low + 0.5)));
            (vec![text(low), text(middle), text(high)], wrong.collect())
        }
        Allowed::Switch => (vec!["off".into(), "on".into()], vec!["maybe".into()]),
        Allowed::Choice(choices) => {
            assert!(choices.len() > 1, "a choice");
            (choices.iter().map(|choice| choice.name.into()).collect(), vec!["neither".into()])
        }
    }
}

#[test]
fn every_option_can_be_shown_and_set() {
    for technique in Technique::all() {
        let options = technique.options();
        let mistake = { technique }.set("no-such", "1").expect_err("no such option").to_string();
        let keys: Vec<&str> = options.iter().map(|option| option.key).collect();
        assert!(mistake.ends_with(&keys.join(", ")), "{technique} lists {keys:?}: {mistake}");
        for (i, option) in options.iter().enumerate() {
            let what = format!("option {} of {technique}", option.key);
            assert_eq!(option.value, option.default, "{what}: new");
            assert!(is_plain(option.help), "{what}: {:?}", option.help);
            let (right, wrong) = right_and_wrong(option.allowed);
            for text in right.iter().chain([&option.default]) {
                let mut changed = technique;
                changed.set(option.key, text).unwrap_or_else(|error| panic!("{what}: {error}"));
                let shown = changed.options();
                assert_eq!(&shown[i].value, text, "{what}: set and shown");
                assert_eq!(shown[i].default, option.default, "{what}: the default stays");
                assert!(
                    shown.iter().zip(&options).all(|(a, b)| a.key == option.key || a == b),
                    "{what}: alone"
                );
                assert_eq!(changed == technique, *text == option.default, "{what}: {text} is another value");
            }
            for text in wrong.iter().chain([&String::new()]) {
                let mut changed = technique;
                assert!(changed.set(option.key, text).is_err(), "{what} is not {text:?}");
                assert_eq!(changed, technique, "{what}: mistakes set nothing");
            }
            if let Allowed::Choice(choices) = option.allowed {
                assert!(choices.iter().all(|choice| is_plain(choice.help)), "{what}: {choices:?}");
            }
        }
    }
}

/// Whether it is sentences for people, without the links of documentation.
fn is_plain(help: &str) -> bool {
    help.starts_with(char::is_uppercase)
        && help.ends_with('.')
        && !["[", "  ", "\n", "::"].iter().any(|odd| help.contains(odd))
}

mod own {
    use crate::input::{Allowed, Choice};
    use crate::technique::options::{Field, Options as _};

    #[derive(Clone, Copy, Debug, PartialEq)]
    enum Kind {
        Soft,
        Hard,
    }

    const KINDS: &[Choice] = &[Choice::new("soft", "One."), Choice::new("hard", "The other.")];

    /// One option of each type.
    #[derive(Clone, Copy, Debug, PartialEq)]
    struct Options {
        map_size: u32,
        bias: f32,
        stencil: bool,
        kind: Kind,
    }

    impl Default for Options {
        fn default() -> Self {
            Self { map_size: 64, bias: 0.5, stencil: true, kind: Kind::Soft }
        }
    }

    impl super::options::Options for Options {
        const FIELDS: &'static [Field<Self>] = &[
            Field::whole("map-size", "A number.", (16, 128), |o| o.map_size, |o, size| o.map_size = size),
            Field::number("bias", "Another, of two lines.", (0.0, 2.0), |o| o.bias, |o, bias| o.bias = bias),
            Field::switch("stencil", "A switch.", |o| o.stencil, |o, on| o.stencil = on),
            Field::choice(
                "kind",
                "A choice.",
                KINDS,
                |o| o.kind as usize,
                |o, place| o.kind = [Kind::Soft, Kind::Hard][place],
            ),
        ];
    }

    #[test]
    fn options_say_what_they_are() {
        let list = Options { bias: f32::NAN, ..Options::default() }.list();
        let said: Vec<_> = list.iter().map(|o| (o.key, o.help, o.value.as_str(), o.allowed)).collect();
        let expected = [
            ("map-size", "A number.", "64", Allowed::Number { low: 16.0, high: 128.0, whole: true }),
            ("bias", "Another, of two lines.", "NaN", Allowed::Number { low: 0.0, high: 2.0, whole: false }),
            ("stencil", "A switch.", "on", Allowed::Switch),
            ("kind", "A choice.", "soft", Allowed::Choice(KINDS)),
        ];
        assert_eq!(said, expected);
        assert_eq!(list[1].default, "0.5");
    }

    #[test]
    fn options_are_read_and_written() {
        let mut options = Options::default();
        assert!(options.changed().is_empty() && options.fault().is_none(), "the defaults are right");
        for (key, value) in [("map-size", "128"), ("bias", "0.25"), ("stencil", "off"), ("kind", "hard")] {
            options.set(key, value).expect("right");
        }
        let expected = Options { map_size: 128, bias: 0.25, stencil: false, kind: Kind::Hard };
        assert_eq!(options, expected, "as said");
        let mut again = Options::default();
        options.changed().iter().for_each(|(key, value)| again.set(key, value).expect("it wrote it"));
        assert_eq!(again, options, "written and read");
        for (key, value, says) in [
            ("map-size", "8", "option `map-size` cannot be `8`; write a number from 16 to 128"),
            ("bias", "NaN", "option `bias` cannot be `NaN`; write a number from 0 to 2"),
            ("bias", "", "option `bias` cannot be ``; write a number from 0 to 2"),
            ("stencil", "true", "option `stencil` cannot be `true`; write on or off"),
            ("kind", "both", "option `kind` cannot be `both`; write soft or hard"),
            ("size", "8", "there is no option `size=8`; the options are map-size, bias, stencil, kind"),
        ] {
            assert_eq!(again.set(key, value).expect_err(value).to_string(), says, "{key}={value}");
        }
        assert_eq!(again, options, "mistakes set nothing");
        assert!(Options { bias: f32::NAN, ..options }.fault().is_some(), "set by a program");
    }
}
