//! Running cargo, with its line and its time shown.

use std::ffi::OsString;
use std::process::Command;
use std::time::Instant;

/// Runs cargo with more variables in its environment.
///
/// # Errors
/// The line that failed.
pub(crate) fn cargo(arguments: &[&str], environment: &[(&str, &str)]) -> Result<(), String> {
    let variables: String = environment.iter().map(|(name, value)| format!("{name}='{value}' ")).collect();
    let line = format!("{variables}cargo {}", arguments.join(" "));
    println!("\n$ {line}");
    let start = Instant::now();
    let program = std::env::var_os("CARGO").unwrap_or_else(|| OsString::from("cargo"));
    let status = Command::new(program)
        .args(arguments)
        .envs(environment.iter().copied())
        .status()
        .map_err(|error| format!("cargo did not start: {error}"))?;
    if !status.success() {
        return Err(format!("`{line}` failed"));
    }
    println!("  took {:.0} s", start.elapsed().as_secs_f64());
    Ok(())
}
