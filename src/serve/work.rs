//! One command in a process of its own: its input, its output, and limits of time, size and number.

use std::fs::OpenOptions;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use tokio::io::{AsyncRead, AsyncReadExt, AsyncWriteExt};
use tokio::process::Command;
use tokio::sync::Semaphore;
use tokio::time;

/// Largest output, in bytes.
const LARGEST: u64 = 1 << 25;
/// Most memory a command may take, in bytes; one that wants more is ended by its allocator. Only Linux lets another process say so.
#[cfg(target_os = "linux")]
const MEMORY: u64 = 1 << 30;
/// Most that is kept of what a command says of errors, in bytes.
const SAID: u64 = 1 << 16;
/// Requests that wait for a command to end; who comes later is told to come again.
const WAITING: usize = 64;

/// A command to run.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Job {
    /// Its arguments.
    pub arguments: Vec<String>,
    /// What it reads from standard input.
    pub input: String,
    /// An option that names a file, and what stands in that file.
    pub file: Option<(&'static str, String)>,
}

/// How a command ended.
pub(super) struct Done {
    /// Its exit status; `None` where a signal ended it.
    pub status: Option<i32>,
    /// What it printed.
    pub out: Vec<u8>,
    /// What it said of errors and doubts.
    pub said: String,
}

/// Why there is no end to tell of.
#[derive(Clone, Debug)]
pub(super) enum NoEnd {
    /// Too many wait already.
    Busy,
    /// It took too long.
    Slow,
    /// It printed too much.
    Large,
    /// It needed too much memory.
    Hungry,
    /// It could not be run.
    Broken(String),
}

/// Where commands are run, no more at a time than there are cores.
pub(super) struct Workshop {
    program: PathBuf,
    doors: Semaphore,
    benches: Semaphore,
    /// How long a command may take. A verdict never hangs on it: what takes longer has no answer here.
    pub(super) longest: Duration,
}

impl Workshop {
    pub(super) fn new(program: PathBuf, seconds: u16) -> Workshop {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        Workshop {
            program,
            doors: Semaphore::new(cores + WAITING),
            benches: Semaphore::new(cores),
            longest: Duration::from_secs(u64::from(seconds)),
        }
    }

    /// Runs a command to its end. A request that is given up ends its command.
    pub(super) async fn run(&self, job: Job, folder: &Path) -> Result<Done, NoEnd> {
        let _inside = self.doors.try_acquire().map_err(|_| NoEnd::Busy)?;
        let _bench = self.benches.acquire().await.map_err(|_| NoEnd::Busy)?;
        match time::timeout(self.longest, self.to_end(job, folder)).await {
            Ok(done) => done,
            Err(_) => Err(NoEnd::Slow),
        }
    }

    async fn to_end(&self, job: Job, folder: &Path) -> Result<Done, NoEnd> {
        let broken = |e: std::io::Error| NoEnd::Broken(e.to_string());
        let mut command = Command::new(&self.program);
        command
            .args(&job.arguments)
            .current_dir(folder)
            // A command has one core; as many run at a time as there are.
            .env("RAYON_NUM_THREADS", "1")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .kill_on_drop(true);
        // An interrupt at the terminal is for the server, which lets its commands end.
        #[cfg(unix)]
        command.process_group(0);
        let draft = match &job.file {
            Some((option, text)) => {
                let draft = Draft::new(text).map_err(broken)?;
                command.arg(format!("{option}={}", draft.path.display()));
                Some(draft)
            }
            None => None,
        };
        let mut child = command.spawn().map_err(broken)?;
        limit_memory(child.id());
        if let Some(mut input) = child.stdin.take() {
            let text = job.input;
            // A command that has read enough closes its end; then the rest is not needed.
            tokio::spawn(async move { input.write_all(text.as_bytes()).await });
        }
        let said = child.stderr.take().map(|e| tokio::spawn(read(e, SAID)));
        let out = match child.stdout.take() {
            Some(out) => read(out, LARGEST + 1).await.map_err(broken)?,
            None => Vec::new(),
        };
        if out.len() as u64 > LARGEST {
            return Err(NoEnd::Large);
        }
        let status = child.wait().await.map_err(broken)?;
        let said = match said {
            Some(said) => said.await.ok().and_then(Result::ok).unwrap_or_default(),
            None => Vec::new(),
        };
        let mut said = String::from_utf8_lossy(&said).into_owned();
        // Who asks knows the text by its field and no file of this machine.
        if let (Some(draft), Some((option, _))) = (draft, &job.file) {
            let path = draft.path.display().to_string();
            said = said.replace(&path, option.trim_start_matches('-'));
        }
        if status.code().is_none() && said.contains("memory allocation of") {
            return Err(NoEnd::Hungry);
        }
        Ok(Done {
            status: status.code(),
            out,
            said,
        })
    }
}

/// Bounds the address space of a command that has just begun.
#[cfg(target_os = "linux")]
fn limit_memory(process: Option<u32>) {
    use rustix::process::{Pid, Resource, Rlimit, prlimit};
    let id = process.and_then(|id| Pid::from_raw(i32::try_from(id).ok()?));
    let limit = Rlimit {
        current: Some(MEMORY),
        maximum: Some(MEMORY),
    };
    // One that has ended already needs no limit.
    id.and_then(|id| prlimit(Some(id), Resource::As, limit).ok());
}

/// Elsewhere nobody can bound another process.
#[cfg(not(target_os = "linux"))]
fn limit_memory(_: Option<u32>) {}

async fn read(from: impl AsyncRead + Unpin, most: u64) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    from.take(most).read_to_end(&mut bytes).await?;
    Ok(bytes)
}

/// A file with a second input of a command; it goes when the command has ended.
struct Draft {
    path: PathBuf,
}

impl Draft {
    fn new(text: &str) -> std::io::Result<Draft> {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let name = format!("carom-{}-{number}.part", std::process::id());
        let path = std::env::temp_dir().join(name);
        let mut options = OpenOptions::new();
        options.write(true).create_new(true);
        #[cfg(unix)]
        std::os::unix::fs::OpenOptionsExt::mode(&mut options, 0o600);
        options.open(&path)?.write_all(text.as_bytes())?;
        Ok(Draft { path })
    }
}

impl Drop for Draft {
    fn drop(&mut self) {
        // That it may be gone already is fine.
        let _ = std::fs::remove_file(&self.path);
    }
}
