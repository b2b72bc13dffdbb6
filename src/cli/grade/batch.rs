//! `carom grade --batch`: JSON lines in, one JSON line out for each, blank ones too, in order.
//!
//! A thread reads blocks of whole lines; tasks on all cores judge them, each with the keys it has read before; the main
//! thread writes. Memory is bounded whatever comes in, and lines that are there are not made to wait for more. Where a
//! signal ends the program, what stands in the output is whole lines.

use std::io::{IsTerminal, Read, Write};
use std::path::Path;
use std::sync::Mutex;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::time::Duration;

use rayon::prelude::*;

use super::{GradeArgs, open};
use crate::cli::Failure;
use crate::cli::files::Held;
use carom::command::{Lines, refuse};
use carom::grade::Options;
use carom::grade::entry::{self, Keys};

/// Bytes asked of standard input at a time.
const READ: usize = 1 << 20;
/// Blocks waiting to be judged.
const WAITING: usize = 8;
/// How often a signal is looked for where no lines come.
const LOOK: Duration = Duration::from_millis(50);
/// Bytes kept of a line that is too long: its `id` should be there.
const START: usize = 1 << 12;
/// Bytes of a task, about.
const TASK: usize = 1 << 16;

/// A piece of the input.
enum Block {
    /// Whole lines; only the last may lack its end.
    Lines(Vec<u8>),
    /// The start of a line that is too long; the rest was read and forgotten.
    Long(Vec<u8>),
    /// Reading failed.
    Failed(std::io::Error),
}

/// Runs a batch over standard input.
pub(super) fn batch(args: &GradeArgs, options: Options) -> Result<u8, Failure> {
    let mut pool = rayon::ThreadPoolBuilder::new();
    if let Some(jobs) = args.jobs {
        pool = pool.num_threads(jobs.clamp(1, 1024));
    }
    let pool = pool
        .build()
        .map_err(|e| Failure::Input(format!("--jobs: {e}")))?;
    let held = Held::new();
    let judges = Judges {
        lines: Lines::new(options, |path| {
            open(Path::new(path)).map_err(|why| match why {
                Failure::Input(words) | Failure::Output(words) => words,
            })
        }),
        idle: Mutex::default(),
        held: &held,
    };
    let progress = progress();
    let (sender, blocks) = sync_channel(WAITING);
    // Not joined: where the answers are no longer wanted, nobody waits for more questions.
    std::thread::spawn(move || send_blocks(&mut std::io::stdin().lock(), &sender));
    let mut out = std::io::stdout().lock();
    let mut read = 0;
    while let Some(blocks) = waiting(&blocks, &held) {
        let mut tasks: Vec<Task> = Vec::new();
        for block in &blocks {
            match block {
                Block::Lines(bytes) => cut(bytes, &mut read, &mut tasks),
                Block::Long(start) => {
                    read += 1;
                    tasks.push(Task::Long(read, start));
                }
                Block::Failed(e) => {
                    return Err(Failure::Input(format!("standard input: {e}")));
                }
            }
        }
        let judged: Vec<(String, bool)> = match tasks.len() {
            // Not worth handing out.
            1 => vec![judges.judge(&tasks[0])],
            _ => pool.install(|| tasks.par_iter().map(|task| judges.judge(task)).collect()),
        };
        // After a signal what was judged goes up to the first line that was not.
        for (text, whole) in judged {
            match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
                Ok(()) => {}
                Err(e) if e.kind() == std::io::ErrorKind::BrokenPipe => return Ok(0),
                Err(e) => return Err(Failure::Output(e.to_string())),
            }
            if !whole {
                break;
            }
        }
        if let Some(bar) = &progress {
            bar.set_position(read);
        }
    }
    if let Some(bar) = progress {
        bar.finish_and_clear();
    }
    held.release();
    Ok(0)
}

/// How far it is, where somebody looks on.
fn progress() -> Option<indicatif::ProgressBar> {
    std::io::stderr().is_terminal().then(|| {
        let bar = indicatif::ProgressBar::new_spinner();
        bar.set_style(
            indicatif::ProgressStyle::with_template("{human_pos} lines, {per_sec}, {elapsed}")
                .unwrap_or_else(|_| indicatif::ProgressStyle::default_spinner()),
        );
        bar
    })
}

/// Reads to the end and sends what comes.
fn send_blocks(input: &mut impl Read, sender: &SyncSender<Block>) {
    let mut held: Vec<u8> = Vec::new();
    // The start of a line that is too long.
    let mut long: Option<Vec<u8>> = None;
    loop {
        let start = held.len();
        held.resize(start + READ, 0);
        let got = match input.read(&mut held[start..]) {
            Ok(got) => got,
            Err(e) if e.kind() == std::io::ErrorKind::Interrupted => 0,
            Err(e) => {
                let _ = sender.send(Block::Failed(e));
                return;
            }
        };
        held.truncate(start + got);
        if got == 0 {
            let rest = match long {
                Some(start) => Block::Long(start),
                None => Block::Lines(held),
            };
            let _ = sender.send(rest);
            return;
        }
        if let Some(start) = &mut long {
            match held.iter().position(|b| *b == b'\n') {
                Some(end) => {
                    held.drain(..=end);
                    let start = std::mem::take(start);
                    long = None;
                    if sender.send(Block::Long(start)).is_err() {
                        return;
                    }
                }
                None => {
                    held.clear();
                    continue;
                }
            }
        }
        if let Some(end) = held.iter().rposition(|b| *b == b'\n') {
            let rest = held.split_off(end + 1);
            if sender.send(Block::Lines(held)).is_err() {
                return;
            }
            held = rest;
        }
        if held.len() > entry::MAX_LINE {
            held.truncate(START);
            long = Some(std::mem::take(&mut held));
        }
    }
}

/// All blocks that are there, at least one; `None` at the end, and after a signal.
fn waiting(blocks: &Receiver<Block>, held: &Held) -> Option<Vec<Block>> {
    loop {
        if held.signal().is_some() {
            return None;
        }
        match blocks.recv_timeout(LOOK) {
            Ok(first) => {
                let mut all = vec![first];
                all.extend(blocks.try_iter().take(WAITING));
                return Some(all);
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return None,
        }
    }
}

/// What one task judges, with the number of its first line.
enum Task<'a> {
    Lines(u64, &'a [u8]),
    Long(u64, &'a [u8]),
}

/// Cuts a block into tasks at ends of lines; `read` lines came before, and those of the block are added.
fn cut<'a>(mut bytes: &'a [u8], read: &mut u64, tasks: &mut Vec<Task<'a>>) {
    while !bytes.is_empty() {
        let end = match bytes.get(TASK..) {
            Some(behind) => {
                let end = behind.iter().position(|b| *b == b'\n');
                end.map_or(bytes.len(), |at| TASK + at + 1)
            }
            None => bytes.len(),
        };
        let (task, rest) = bytes.split_at(end);
        tasks.push(Task::Lines(*read + 1, task));
        let ends = task.iter().filter(|b| **b == b'\n').count();
        *read += ends as u64 + u64::from(!task.ends_with(b"\n"));
        bytes = rest;
    }
}

/// What all tasks share.
struct Judges<'a> {
    lines: Lines,
    /// Keys read so far, while no task is at work with them.
    idle: Mutex<Vec<Keys>>,
    held: &'a Held,
}

impl Judges<'_> {
    /// The lines that answer a task, and whether these are all; after a signal they need not be.
    fn judge(&self, task: &Task) -> (String, bool) {
        let rested = match self.idle.lock() {
            Ok(mut idle) => idle.pop(),
            Err(_) => None,
        };
        let mut keys = rested.unwrap_or_default();
        let mut out = String::new();
        let mut whole = true;
        match task {
            Task::Long(number, start) => {
                let message = format!("a line has at most {} bytes", entry::MAX_LINE);
                refuse(start, *number, message, &mut out);
            }
            Task::Lines(first, bytes) => {
                out.reserve(bytes.len() * 3 / 2);
                let bytes = bytes.strip_suffix(b"\n").unwrap_or(bytes);
                let mut number = *first;
                let mut one = |line: Result<&str, &[u8]>| {
                    if self.held.signal().is_some() {
                        return false;
                    }
                    match line {
                        Ok(text) => self.lines.judge(&mut keys, text, number, &mut out),
                        Err(line) => {
                            let good = String::from_utf8_lossy(line);
                            let at = good.find('\u{fffd}').unwrap_or_default();
                            refuse(line, number, format!("no UTF-8 at byte {at}"), &mut out);
                        }
                    }
                    number += 1;
                    true
                };
                let lines = |b: &u8| *b == b'\n';
                whole = match std::str::from_utf8(bytes) {
                    Ok(text) => text.split('\n').all(|line| one(Ok(line))),
                    Err(_) => bytes
                        .split(lines)
                        .all(|line| one(std::str::from_utf8(line).map_err(|_| line))),
                };
            }
        }
        if let Ok(mut idle) = self.idle.lock() {
            idle.push(keys);
        }
        (out, whole)
    }
}
