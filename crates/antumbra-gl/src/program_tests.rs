//! Every permutation of every program, by the driver and by the reference compiler.

use crate::gl::{Program, ProgramSource, Variant};
use crate::masks::{RATIO_PROGRAM, SAMPLE_PROGRAMS, SUM_PROGRAMS};
use crate::{Caps, Technique};
use antumbra_host::{Api, TestContext};
use glow::HasContext;
use std::io::Write;
use std::process::{Command, Stdio};

/// The overlay's programs, those that sample lights, and every technique's.
fn programs() -> Vec<&'static ProgramSource> {
    let techniques = Technique::all().flat_map(|technique| technique.programs());
    SUM_PROGRAMS.iter().chain(RATIO_PROGRAM).chain(SAMPLE_PROGRAMS).chain(techniques).collect()
}

fn required() -> bool {
    std::env::var_os("ANTUMBRA_REQUIRE_GL").is_some()
}

#[test]
fn every_permutation_compiles_and_links() {
    for api in [Api::Gl33, Api::Gles30] {
        let Some(context) = TestContext::new(api) else { continue };
        let gl = context.gl();
        let caps = Caps::query(gl).expect("a context that antumbra runs on");
        let mut count = 0;
        for variant in Variant::all().filter(|v| !v.multisample || caps.sample_shading()) {
            for source in programs() {
                let program = Program::new(gl, &caps, source, variant)
                    .unwrap_or_else(|e| panic!("{api:?}, {}, {variant:?}: {e}", source.name));
                // SAFETY: made above.
                unsafe { gl.delete_program(program.raw) };
                count += 1;
            }
        }
        let variants = if caps.sample_shading() { Variant::COUNT } else { Variant::COUNT / 2 };
        assert_eq!(count, programs().len() * variants, "all of them");
        // SAFETY: asks for the error flag.
        assert_eq!(unsafe { gl.get_error() }, glow::NO_ERROR, "{api:?}");
    }
}

/// Indices and variants are each other's inverse: a program is found where it was put.
#[test]
fn variants_have_indices_of_their_own() {
    for (i, variant) in Variant::all().enumerate() {
        assert_eq!(variant.index(), i, "{variant:?}");
    }
    assert_eq!(Variant::all().count(), Variant::COUNT, "all of them");
}

/// What one driver lets pass another may refuse: the reference compiler goes by the specification.
#[test]
fn every_permutation_is_valid_glsl() {
    if Command::new("glslangValidator").arg("--version").stdout(Stdio::null()).status().is_err() {
        assert!(!required(), "glslangValidator is missing; install glslang-tools");
        eprintln!("SKIPPED: glslangValidator is missing; install glslang-tools");
        return;
    }
    for embedded in [false, true] {
        for variant in Variant::all().filter(|v| !(embedded && v.multisample)) {
            for source in programs() {
                for (stage, text) in ["vert", "frag"].into_iter().zip(source.sources(embedded, variant)) {
                    let what = format!("{} {stage}, embedded {embedded}, {variant:?}", source.name);
                    validate(&what, stage, &text);
                }
            }
        }
    }
}

fn validate(what: &str, stage: &str, source: &str) {
    let mut validator = Command::new("glslangValidator")
        .args(["--stdin", "-S", stage])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("glslangValidator starts");
    let mut input = validator.stdin.take().expect("its input");
    input.write_all(source.as_bytes()).expect("it reads its input");
    drop(input);
    let output = validator.wait_with_output().expect("it ends");
    let says = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{what}: {says}\n{source}");
}
