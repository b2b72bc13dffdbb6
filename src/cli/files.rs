//! Input read up to a limit, and output written whole or not at all.
//!
//! A regular file is written beside its place and renamed, with the mode it had; where a link leads, the link stays.
//! What is no regular file, such as a device or a pipe, is written through. The file that was read is never replaced.

use std::fs::{File, Metadata, OpenOptions};
use std::io::{ErrorKind, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use signal_hook::SigId;
use signal_hook::consts::{SIGINT, SIGTERM};

use super::{Failure, refused};

/// Links followed before they count as a circle.
const LINKS: usize = 40;

/// Reads a text, `-` for standard input. No more is read than `limit` bytes and one, whatever else would come.
pub(super) fn read(path: &Path, limit: usize) -> Result<String, Failure> {
    let unreadable = |e: std::io::Error| refused(path, format!("cannot be read: {e}"));
    let source: Box<dyn Read> = match path.to_str() {
        Some("-") => Box::new(std::io::stdin().lock()),
        _ => Box::new(File::open(path).map_err(unreadable)?),
    };
    let mut bytes = Vec::new();
    let most = (limit as u64).saturating_add(1);
    let read = source.take(most).read_to_end(&mut bytes);
    read.map_err(unreadable)?;
    if bytes.len() > limit {
        let why = format!("too long: at most {limit} bytes are read");
        return Err(refused(path, why));
    }
    String::from_utf8(bytes).map_err(|e| {
        let at = e.utf8_error().valid_up_to();
        refused(path, format!("cannot be read: no UTF-8 at byte {at}"))
    })
}

/// Writes a file whole or not at all, `-` for standard output. None of the files in `read` may be the one written.
pub(super) fn save(path: &Path, bytes: &[u8], read: &[&Path]) -> Result<(), Failure> {
    if path.as_os_str() == "-" {
        return through(std::io::stdout().lock(), path, bytes);
    }
    writable(path, read)?;
    let unwritable = |e: std::io::Error| unwritable(path, &e);
    let old = std::fs::metadata(path).ok();
    let in_place = old.as_ref().is_some_and(|m| !m.is_file() || has_names(m));
    // A link to an open pipe leads to no name.
    let target = match in_place {
        true => path.to_path_buf(),
        false => followed(path).map_err(unwritable)?,
    };
    if in_place {
        let is_file = old.is_some_and(|m| m.is_file());
        let mut file = OpenOptions::new();
        let file = file.write(true).truncate(is_file).open(&target);
        return through(file.map_err(unwritable)?, path, bytes);
    }
    let draft = target.with_file_name(format!(".carom-{}.part", std::process::id()));
    let held = Held::new();
    let made = OpenOptions::new().write(true).create_new(true).open(&draft);
    let mut file = made.map_err(unwritable)?;
    let written = file
        .write_all(bytes)
        .and_then(|()| old.map_or(Ok(()), |m| file.set_permissions(m.permissions())));
    drop(file);
    let outcome = match held.signal() {
        Some(_) => Ok(false),
        None => written.and_then(|()| std::fs::rename(&draft, &target).map(|()| true)),
    };
    if !matches!(outcome, Ok(true)) {
        // Nothing half-written stays behind; that the draft may not exist any more is fine.
        let _ = std::fs::remove_file(&draft);
    }
    held.release();
    match outcome {
        Ok(_) => Ok(()),
        Err(e) => Err(Failure::Output(format!("{}: {e}", path.display()))),
    }
}

/// Refuses a place that cannot be written, or that is one of the files in `read`.
pub(super) fn writable(path: &Path, read: &[&Path]) -> Result<(), Failure> {
    if read.iter().any(|input| is_same(path, input)) {
        let why = "is what was read, and would be lost\nhint: name another file";
        return Err(refused(path, why));
    }
    match std::fs::metadata(path) {
        Ok(found) if found.is_dir() => Err(unwritable(path, &ErrorKind::IsADirectory.into())),
        // A file that must not be written is not replaced either.
        Ok(found) if found.is_file() => match OpenOptions::new().write(true).open(path) {
            Ok(_) => Ok(()),
            Err(e) => Err(unwritable(path, &e)),
        },
        Err(e) if e.kind() == ErrorKind::NotFound => match path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() && !folder.is_dir() => {
                Err(unwritable(path, &e))
            }
            _ => Ok(()),
        },
        _ => Ok(()),
    }
}

fn unwritable(path: &Path, e: &std::io::Error) -> Failure {
    Failure::Output(format!("{}: {e}", path.display()))
}

/// Writes to what stays where it is. Whoever reads the other end of a pipe may have seen enough.
fn through(mut out: impl Write, path: &Path, bytes: &[u8]) -> Result<(), Failure> {
    match out.write_all(bytes).and_then(|()| out.flush()) {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::Output(format!("{}: {e}", path.display())))
        }
        _ => Ok(()),
    }
}

/// Where a path leads, through links, whether something stands there or not.
fn followed(path: &Path) -> std::io::Result<PathBuf> {
    let mut at = path.to_path_buf();
    for _ in 0..LINKS {
        if !std::fs::symlink_metadata(&at).is_ok_and(|m| m.is_symlink()) {
            return Ok(at);
        }
        let target = std::fs::read_link(&at)?;
        at = at.parent().unwrap_or(Path::new("")).join(target);
    }
    Err(std::io::Error::other("the links run in a circle"))
}

/// Whether a file has more names than one: renaming would part them.
#[cfg(unix)]
fn has_names(file: &Metadata) -> bool {
    std::os::unix::fs::MetadataExt::nlink(file) > 1
}

#[cfg(not(unix))]
fn has_names(_: &Metadata) -> bool {
    false
}

/// Whether two paths name one regular file.
fn is_same(a: &Path, b: &Path) -> bool {
    let b = match b.as_os_str() == "-" {
        true => Path::new("/dev/stdin"),
        false => b,
    };
    let both = std::fs::metadata(a).and_then(|a| Ok((a, std::fs::metadata(b)?)));
    let Ok((of_a, of_b)) = both else {
        return false;
    };
    let named = || match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b,
        _ => false,
    };
    of_a.is_file() && of_b.is_file() && (has_one_node(&of_a, &of_b) || named())
}

#[cfg(unix)]
fn has_one_node(a: &Metadata, b: &Metadata) -> bool {
    use std::os::unix::fs::MetadataExt;
    a.dev() == b.dev() && a.ino() == b.ino()
}

#[cfg(not(unix))]
fn has_one_node(_: &Metadata, _: &Metadata) -> bool {
    false
}

/// Signals held back until a piece of work is whole.
pub(super) struct Held {
    seen: Arc<AtomicUsize>,
    handlers: Vec<SigId>,
}

impl Held {
    /// Holds back what would end the program from now on. A file that grows too large is an error of its write then.
    pub(super) fn new() -> Held {
        let seen = Arc::new(AtomicUsize::new(0));
        #[cfg(unix)]
        let more = [signal_hook::consts::SIGHUP, signal_hook::consts::SIGXFSZ];
        #[cfg(not(unix))]
        let more: [i32; 0] = [];
        let signals = [SIGINT, SIGTERM].into_iter().chain(more);
        let handlers = signals.filter_map(|signal| {
            let number = usize::try_from(signal).ok()?;
            signal_hook::flag::register_usize(signal, seen.clone(), number).ok()
        });
        Held {
            handlers: handlers.collect(),
            seen,
        }
    }

    /// The signal that came and wants the program to end.
    pub(super) fn signal(&self) -> Option<i32> {
        let signal = i32::try_from(self.seen.load(Ordering::SeqCst)).ok()?;
        #[cfg(unix)]
        if signal == signal_hook::consts::SIGXFSZ {
            return None;
        }
        (signal != 0).then_some(signal)
    }

    /// Holds back no more: what came meanwhile acts now.
    pub(super) fn release(self) {
        let came = self.signal();
        for handler in self.handlers {
            signal_hook::low_level::unregister(handler);
        }
        if let Some(signal) = came {
            // Ends the program as the signal would have; where that cannot be, the work goes on.
            let _ = signal_hook::low_level::emulate_default_handler(signal);
        }
    }
}
