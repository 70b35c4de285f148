//! What the tests need from the system: found, installed where that may be done, or named.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// One thing that the tests need.
struct Need {
    /// What it is for.
    what: &'static str,
    /// The Debian package that has it, or several with blanks between them.
    package: &'static str,
    /// Whether it is there.
    found: fn() -> bool,
}

const NEEDS: [Need; 9] = [
    Need {
        what: "libEGL.so.1: OpenGL without a window",
        package: "libegl1",
        found: || library("libEGL.so.1") && (library("libEGL_mesa.so.0") || library("libEGL_nvidia.so.0")),
    },
    Need {
        what: "Mesa's software renderer, llvmpipe",
        package: "libgl1-mesa-dri",
        found: || {
            dri_directories().iter().any(|directory| directory.join("swrast_dri.so").exists()) || gallium()
        },
    },
    Need { what: "libGLESv2.so.2: OpenGL ES", package: "libgles2", found: || library("libGLESv2.so.2") },
    Need {
        what: "glslangValidator: checks the shaders against the GLSL standard",
        package: "glslang-tools",
        found: || in_path("glslangValidator"),
    },
    Need { what: "Xvfb: a display for the tests of the viewer", package: "xvfb", found: || in_path("Xvfb") },
    // What the viewer loads when it opens a window in X11.
    Need {
        what: "libX11-xcb.so.1: windows, keys and mouse",
        package: "libx11-xcb1",
        found: || library("libX11.so.6") && library("libX11-xcb.so.1"),
    },
    Need {
        what: "libXcursor.so.1 and libXi.so.6: pointers",
        package: "libxcursor1 libxi6",
        found: || library("libXcursor.so.1") && library("libXi.so.6"),
    },
    Need {
        what: "libxkbcommon-x11.so.0: keyboards",
        package: "libxkbcommon-x11-0",
        found: || library("libxkbcommon.so.0") && library("libxkbcommon-x11.so.0"),
    },
    Need {
        what: "models in glTF 2.0 and OBJ: real files for the mesh readers",
        package: "assimp-testmodels",
        found: models,
    },
];

/// Finds or installs what the tests need.
///
/// # Errors
/// What is missing and how to install it, where this program may not.
pub(crate) fn run() -> Result<(), String> {
    let missing = missing();
    if missing.is_empty() {
        println!("setup: everything that the tests need is there");
        return Ok(());
    }
    for need in &missing {
        println!("setup: missing {} (Debian package {})", need.what, need.package);
    }
    let packages: Vec<&str> = missing.iter().flat_map(|need| need.package.split(' ')).collect();
    match installer() {
        Some(prefix) => install(&prefix, &packages)?,
        None => return Err(advice(&packages)),
    }
    let missing = self::missing();
    if missing.is_empty() {
        println!("setup: installed {}", packages.join(" "));
        return Ok(());
    }
    let what: Vec<&str> = missing.iter().map(|need| need.what).collect();
    Err(format!("installed {}, and still missing: {}", packages.join(" "), what.join("; ")))
}

/// The target of browsers.
pub(crate) const WEB: &str = "wasm32-unknown-unknown";

/// Sees to it that the standard library is there for another target.
///
/// # Errors
/// Why it is not, where it can be brought neither by rustup nor was there.
pub(crate) fn target(name: &str) -> Result<(), String> {
    let installed = || {
        output("rustc", &["--print", "target-libdir", "--target", name])
            .is_some_and(|folder| Path::new(folder.trim()).is_dir())
    };
    if installed() {
        return Ok(());
    }
    println!("setup: rustup target add {name}");
    let added = succeeds("rustup", &["target", "add", name]);
    if added && installed() {
        Ok(())
    } else {
        Err(format!("`rustup target add {name}` did not bring the target"))
    }
}

fn missing() -> Vec<&'static Need> {
    NEEDS.iter().filter(|need| !(need.found)()).collect()
}

/// What to put before `apt-get`: nothing for root, `sudo -n` where that asks no password; `None` where packages
/// cannot be installed.
fn installer() -> Option<Vec<&'static str>> {
    if !in_path("apt-get") {
        return None;
    }
    if output("id", &["-u"]).is_some_and(|id| id.trim() == "0") {
        return Some(Vec::new());
    }
    (in_path("sudo") && succeeds("sudo", &["-n", "true"])).then(|| vec!["sudo", "-n"])
}

fn install(prefix: &[&str], packages: &[&str]) -> Result<(), String> {
    let apt = |arguments: &[&str]| {
        let mut words: Vec<&str> = prefix.to_vec();
        // `env` because sudo drops the environment; without it a package may stop and ask.
        words.extend(["env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "-y", "-q"]);
        words.extend(arguments);
        println!("setup: {}", words.join(" "));
        let status = Command::new(words[0]).args(&words[1..]).stdin(Stdio::null()).status();
        match status {
            Ok(status) if status.success() => Ok(()),
            Ok(status) => Err(format!("`{}` failed ({status})", words.join(" "))),
            Err(error) => Err(format!("`{}` did not start: {error}", words[0])),
        }
    };
    // The package lists may be old in one source and still do for the rest: what counts is whether the install works.
    if let Err(error) = apt(&["update"]) {
        println!("setup: {error}; going on with the package lists that are there");
    }
    let mut arguments = vec!["install", "--no-install-recommends"];
    arguments.extend(packages);
    apt(&arguments).map_err(|error| format!("{error}; install by hand: {}", packages.join(" ")))
}

fn advice(packages: &[&str]) -> String {
    format!(
        "install what is missing, then run this again:\n  \
         Debian, Ubuntu:  sudo apt-get update && sudo apt-get install {}\n  \
         Fedora:          sudo dnf install mesa-libEGL mesa-dri-drivers libglvnd-gles glslang \\\n  \
                           xorg-x11-server-Xvfb libX11-xcb libXcursor libXi libxkbcommon-x11\n  \
         Arch:            sudo pacman -S mesa libglvnd glslang xorg-server-xvfb libx11 libxcursor libxi libxkbcommon-x11\n\
         The models are the folder test/models of the Asset Importer Library's sources; where no package has them,\n\
         set ANTUMBRA_MODELS to it.\n\
         The tests draw without a window through EGL, and the viewer's in a window of Xvfb; macOS and Windows have\n\
         neither: there, run them in a\n\
         Linux container.",
        packages.join(" ")
    )
}

/// Whether the dynamic linker finds a shared library.
fn library(name: &str) -> bool {
    let cached = ["ldconfig", "/sbin/ldconfig", "/usr/sbin/ldconfig"]
        .into_iter()
        .find_map(|program| output(program, &["-p"]))
        .is_some_and(|list| list.lines().any(|line| line.split_whitespace().next() == Some(name)));
    cached || library_directories().iter().any(|directory| directory.join(name).exists())
}

fn library_directories() -> Vec<PathBuf> {
    let multiarch = format!("/usr/lib/{}-linux-gnu", std::env::consts::ARCH);
    let fixed = [multiarch.as_str(), "/usr/lib64", "/usr/lib", "/usr/local/lib"].map(PathBuf::from);
    listed("LD_LIBRARY_PATH").into_iter().chain(fixed).collect()
}

fn dri_directories() -> Vec<PathBuf> {
    let beside = library_directories().into_iter().map(|directory| directory.join("dri"));
    listed("LIBGL_DRIVERS_PATH").into_iter().chain(beside).collect()
}

/// Newer releases of Mesa have all their drivers in one library.
fn gallium() -> bool {
    library_directories()
        .iter()
        .filter_map(|directory| directory.read_dir().ok())
        .flat_map(|entries| entries.flatten())
        .any(|entry| entry.file_name().to_string_lossy().starts_with("libgallium-"))
}

/// Whether the models of the Asset Importer Library are there: installed, or where `ANTUMBRA_MODELS` says.
fn models() -> bool {
    let folder = std::env::var_os("ANTUMBRA_MODELS").map_or("/usr/share/assimp/models".into(), PathBuf::from);
    folder.join("glTF2").is_dir() && folder.join("OBJ").is_dir()
}

fn in_path(program: &str) -> bool {
    listed("PATH").iter().any(|directory| directory.join(program).is_file())
}

/// The directories that an environment variable lists.
fn listed(variable: &str) -> Vec<PathBuf> {
    let value = std::env::var_os(variable).unwrap_or_default();
    std::env::split_paths(&value).filter(|path| path != Path::new("")).collect()
}

fn output(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).stdin(Stdio::null()).output().ok()?;
    output.status.success().then(|| String::from_utf8_lossy(&output.stdout).into_owned())
}

fn succeeds(program: &str, arguments: &[&str]) -> bool {
    output(program, arguments).is_some()
}
