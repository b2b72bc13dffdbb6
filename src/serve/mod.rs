//! `carom serve`: the workbench in a browser, and HTTP for programs.
//!
//! In: a folder of scenes, an address, and the program that runs the commands. Out: a server that answers until it is
//! interrupted. Every derivation, solution or grade is a command of its own process with a limit of time, so that no input
//! of a stranger can stop the server, and what comes back is what the command prints. Decides nothing about mechanics.

mod commands;
mod describe;
mod folder;
mod openapi;
mod request;
mod routes;
mod work;

use std::io::ErrorKind;
use std::net::{IpAddr, SocketAddr};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::GracefulShutdown;
use hyper_util::service::TowerToHyperService;
use tokio::net::TcpListener;
use tokio::signal;
use tokio::sync::Semaphore;
use tokio::time;

pub use describe::{Asked, Filmed, Wrong, describe};
use folder::Folder;
use work::Workshop;

/// What a server is started with.
#[derive(Clone, Debug)]
pub struct Options {
    /// The folder with the scenes; nothing outside of it is read.
    pub folder: PathBuf,
    /// Where to listen.
    pub host: IpAddr,
    /// The port; 0 takes one that is free.
    pub port: u16,
    /// The program that runs the commands.
    pub program: PathBuf,
    /// How long a command may take \[s\].
    pub seconds: u16,
}

/// Connections at a time; who comes later waits until one ends.
const CONNECTIONS: usize = 256;
/// How long a client may take to send the head of a request, and may be silent between two of them.
const HEAD: Duration = Duration::from_secs(15);
/// Largest head of a request, in bytes.
const HEAD_SIZE: usize = 1 << 14;
/// How long requests that are being answered may still take when the server is to stop.
const LAST: Duration = Duration::from_secs(5);

/// What all requests share.
struct Shared {
    folder: Folder,
    workshop: Workshop,
    /// Whether only this machine is served. Then the name asked for has to be this machine's: a page of a stranger whose
    /// name was bent to this address gets nothing.
    is_local: bool,
}

/// Serves until an interrupt; `ready` is told the address and how many scenes there are.
pub fn serve(options: &Options, ready: impl FnOnce(SocketAddr, usize)) -> Result<(), String> {
    let shown = options.folder.display();
    let folder = Folder::open(&options.folder).map_err(|e| format!("{shown}: {e}"))?;
    let scenes = folder.names().len();
    if scenes == 0 {
        return Err(format!(
            "{shown}: no scenes\nhint: name a folder with scene files (.json), such as derivations"
        ));
    }
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()
        .map_err(|e| format!("the server cannot be started: {e}"))?;
    let outcome = runtime.block_on(async {
        let asked = SocketAddr::new(options.host, options.port);
        let listener = TcpListener::bind(asked)
            .await
            .map_err(|e| unreachable_address(asked, &e))?;
        let address = listener.local_addr().unwrap_or(asked);
        let shared = Shared {
            folder,
            workshop: Workshop::new(options.program.clone(), options.seconds),
            is_local: options.host.is_loopback(),
        };
        ready(address, scenes);
        accept(listener, Arc::new(shared)).await;
        Ok(())
    });
    // Work that was not waited for is not waited for here either.
    runtime.shutdown_background();
    outcome
}

fn unreachable_address(asked: SocketAddr, e: &std::io::Error) -> String {
    match e.kind() {
        ErrorKind::AddrInUse => format!(
            "{asked}: the port is in use\nhint: choose another with --port, or --port 0 for one that is free"
        ),
        ErrorKind::PermissionDenied => {
            format!("{asked}: this port is not allowed\nhint: choose one above 1023 with --port")
        }
        ErrorKind::AddrNotAvailable => {
            format!("{asked}: this machine has no such address\nhint: leave out --host")
        }
        _ => format!("{asked}: {e}"),
    }
}

/// Takes connections until the interrupt, then lets those that are being answered end.
async fn accept(listener: TcpListener, shared: Arc<Shared>) {
    let routes = routes::routes(shared);
    let places = Arc::new(Semaphore::new(CONNECTIONS));
    let graceful = GracefulShutdown::new();
    let mut interrupt = std::pin::pin!(interrupt());
    loop {
        let next = async {
            let place = places.clone().acquire_owned().await;
            (place, listener.accept().await)
        };
        let next = std::pin::pin!(next);
        let Some((place, accepted)) = first(next, interrupt.as_mut()).await else {
            break;
        };
        let (Ok(place), Ok((stream, _))) = (place, accepted) else {
            // Out of file descriptors, or a client that left: others may still come.
            time::sleep(Duration::from_millis(20)).await;
            continue;
        };
        let _ = stream.set_nodelay(true);
        let service = TowerToHyperService::new(routes.clone());
        let connection = http1::Builder::new()
            .timer(TokioTimer::new())
            .header_read_timeout(HEAD)
            .max_header_size(HEAD_SIZE)
            .serve_connection(TokioIo::new(stream), service);
        let connection = graceful.watcher().watch(connection);
        tokio::spawn(async move {
            // A client that breaks off is no concern of the others.
            let _ = connection.await;
            drop(place);
        });
    }
    drop(listener);
    let _ = time::timeout(LAST, graceful.shutdown()).await;
}

/// What comes first: the work, or the end (`None`).
async fn first<T>(
    mut work: std::pin::Pin<&mut impl Future<Output = T>>,
    mut end: std::pin::Pin<&mut impl Future<Output = ()>>,
) -> Option<T> {
    std::future::poll_fn(|cx| {
        if end.as_mut().poll(cx).is_ready() {
            return std::task::Poll::Ready(None);
        }
        work.as_mut().poll(cx).map(Some)
    })
    .await
}

/// Waits for the interrupt, or for being asked to end.
async fn interrupt() {
    #[cfg(unix)]
    if let Ok(mut terminate) = signal::unix::signal(signal::unix::SignalKind::terminate()) {
        let ended = std::pin::pin!(async {
            terminate.recv().await;
        });
        let _ = first(std::pin::pin!(signal::ctrl_c()), ended).await;
        return;
    }
    let _ = signal::ctrl_c().await;
}
