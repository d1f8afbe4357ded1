//! Child processes that are forked in a function of the user which the engine has called.

/// The exit status of a child that was forked in a callback and came back (`EX_SOFTWARE` of sysexits.h).
const FORKED: i32 = 70;

/// Ends this process if it is a child that was forked in `callback`, a function of the user that `process` called. The
/// search does not continue in a child.
pub(crate) fn end_if_forked(process: u32, callback: &str) {
    if std::process::id() != process {
        eprintln!("niwaki: the search stays in the parent of this fork; end the child in {callback}");
        std::process::exit(FORKED);
    }
}
