//! The list of techniques, and their names and options as text.

use super::*;

#[test]
fn every_technique_reads_what_it_writes() {
    assert_eq!(Technique::all().count(), Technique::NAMES.len(), "one a name");
    for (i, technique) in Technique::all().enumerate() {
        assert_eq!(technique.index(), i, "{technique} is where its name is");
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
    let of = |text: &str| Technique::parse(text).expect_err(text);
    assert_eq!(
        of("analitic"),
        format!("there is no technique `analitic`; the techniques are {}", Technique::NAMES.join(", ")),
        "a typing mistake"
    );
    assert!(of("").contains("the techniques are"), "nothing at all");
    assert!(of("analytic:size=3").contains("there is no option `size=3`"), "{}", of("analytic:size=3"));
    assert!(of("analytic:").contains("there is no option"), "{}", of("analytic:"));
}

#[expect(unreachable_pub, reason = "the macros declare what a crate makes public")]
mod own {
    use crate::technique::options::{Options as _, choices, options};

    choices! {
        /// A choice.
        pub enum Kind {
            /// One.
            Soft = "soft",
            /// The other.
            Hard = "hard",
        }
    }

    options! {
        /// One option of each type.
        pub struct Options {
            /// A number.
            pub map_size: u32 = 64, 16..=128;
            /// Another.
            pub bias: f32 = 0.5, 0.0..=2.0;
            /// A switch.
            pub stencil: bool = true, ();
            /// A choice.
            pub kind: Kind = Kind::Soft, ();
        }
    }

    #[test]
    fn options_are_read_and_written() {
        let mut options = Options::default();
        assert!(options.changed().is_empty() && options.fault().is_none(), "the defaults are right");
        for (key, value) in [("map-size", "128"), ("bias", "0.25"), ("stencil", "off"), ("kind", "hard")] {
            options.set(key, value).expect("right");
        }
        assert_eq!(
            options,
            Options { map_size: 128, bias: 0.25, stencil: false, kind: Kind::Hard },
            "as said"
        );
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
            assert_eq!(again.set(key, value), Err(says.to_owned()), "{key}={value}");
        }
        assert_eq!(again, options, "mistakes set nothing");
        assert!(Options { bias: f32::NAN, ..options }.fault().is_some(), "set by a program");
    }
}
