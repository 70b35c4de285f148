//! Ends that come from outside: Ctrl-C, termination, and a terminal that hangs up.

use super::staged::abandon;

/// From now on a signal that asks the program to end removes the temporary files first. The exit code is 128 and the
/// signal's number: 130 for an interrupt, 143 for termination, 129 for hanging up.
///
/// Without a handler the program would end at once, and a temporary file may stay: a nuisance, so failing to have one
/// is no error.
#[cfg(unix)]
pub(crate) fn clean_up_on_signals() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;

    let (sender, receiver) = std::sync::mpsc::sync_channel::<Signals>(1);
    let wait = move || {
        if let Ok(mut signals) = receiver.recv()
            && let Some(signal) = signals.forever().next()
        {
            abandon(128 + signal);
        }
    };
    // The thread first: a signal that is caught and that nobody waits for could not end the program.
    if std::thread::Builder::new().name("signals".into()).spawn(wait).is_err() {
        return;
    }
    let hangup = (!hangup_is_ignored()).then_some(SIGHUP);
    if let Ok(signals) = Signals::new([SIGINT, SIGTERM].into_iter().chain(hangup)) {
        let _ = sender.send(signals);
    }
}

/// As on Unix, for what the system has: Ctrl-C, Ctrl-Break and a console that is closed. The exit code is 130.
#[cfg(not(unix))]
pub(crate) fn clean_up_on_signals() {
    let _ = ctrlc::set_handler(|| abandon(130));
}

/// Whether whoever started the program wants it to outlive its terminal, as `nohup` does. Only Linux tells; elsewhere
/// hanging up is left to do what it does.
#[cfg(unix)]
fn hangup_is_ignored() -> bool {
    let Ok(about) = std::fs::read_to_string("/proc/self/status") else { return true };
    let ignored = about.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    // Signals count from 1, bits from 0.
    let bit = 1 << (signal_hook::consts::SIGHUP - 1);
    ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).is_none_or(|mask| mask & bit != 0)
}
