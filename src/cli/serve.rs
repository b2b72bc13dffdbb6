//! `carom serve`: the workbench in a browser; and what it asks about a scene.

use std::net::{IpAddr, Ipv4Addr};
use std::path::PathBuf;

use clap::Args;

use super::{Failure, SceneArgs, complain, files, print, versioned};
use carom::{scene, serve};

/// Arguments of `carom serve`.
#[derive(Args)]
pub struct ServeArgs {
    /// Folder with the scenes; nothing outside of it is read
    #[arg(default_value = "derivations")]
    folder: PathBuf,
    /// Port to listen at; 0 takes one that is free
    #[arg(long, default_value_t = 8017)]
    port: u16,
    /// Address to listen at; other machines reach only an address that is theirs to reach, such as 0.0.0.0
    #[arg(long, value_name = "ADDRESS", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    host: IpAddr,
    /// How long the work on a request may take, in seconds
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u16).range(1..))]
    seconds: u16,
}

/// Arguments of `carom describe`.
#[derive(Args)]
pub struct DescribeArgs {
    #[command(flatten)]
    input: SceneArgs,
    /// Tell how this formula is read; may be repeated
    #[arg(long, allow_hyphen_values = true)]
    formula: Vec<String>,
    /// Typeset this symbol, given in LaTeX; may be repeated
    #[arg(long, allow_hyphen_values = true)]
    symbol: Vec<String>,
    /// Tell how the bodies come to the first impact, and how they go on after the last
    #[arg(long)]
    film: bool,
    /// With --film: show an answer to this question beside the right motion
    #[arg(long, requires = "film", requires = "answer")]
    quantity: Option<String>,
    /// With --film: the answer
    #[arg(long, requires = "quantity", allow_hyphen_values = true)]
    answer: Option<String>,
}

/// Serves until it is interrupted.
pub fn run(args: &ServeArgs) -> Result<u8, Failure> {
    let program = std::env::current_exe()
        .map_err(|e| Failure::Input(format!("the program itself is not found: {e}")))?;
    let options = serve::Options {
        folder: args.folder.clone(),
        host: args.host,
        port: args.port,
        program,
        seconds: args.seconds,
    };
    let mut told = Ok(());
    serve::serve(&options, |address, scenes| {
        told = print(&format!("http://{address}/\n"));
        complain(&format!(
            "{}: {scenes} scenes; Ctrl-C ends",
            args.folder.display()
        ));
    })
    .map_err(Failure::Input)?;
    told.map(|()| 0)
}

/// Describes a scene for pages and editors.
pub fn describe(args: &DescribeArgs) -> Result<u8, Failure> {
    let text = files::read(&args.input.scene, scene::LONGEST)?;
    let each = args.input.set.iter().map(|assignment| {
        let (name, value) = assignment.split_once('=').unwrap_or((assignment, ""));
        (name.trim().to_string(), value.trim().to_string())
    });
    let asked = serve::Asked {
        set: each.collect(),
        formulas: args.formula.clone(),
        symbols: args.symbol.clone(),
        film: args.film.then(|| {
            let claim = args.quantity.clone().zip(args.answer.clone());
            serve::Filmed {
                claim: claim.map(|(name, answer)| [name, answer]),
            }
        }),
    };
    match serve::describe(&text, &asked) {
        Ok(description) => print(&versioned(&description)).map(|()| 0),
        Err(serve::Wrong::Scene(faults)) => print(&versioned(&faults)).map(|()| 2),
        Err(serve::Wrong::Value(message)) => Err(Failure::Input(message)),
    }
}
