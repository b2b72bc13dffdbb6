//! `carom serve`: the workbench in a browser; and what it asks about a scene.

use std::net::{IpAddr, Ipv4Addr};
use std::path::PathBuf;

use clap::Args;

use super::{Failure, complain, files, pretty, print};
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
}

/// Arguments of `carom describe`.
#[derive(Args)]
pub struct DescribeArgs {
    /// Scene file, `-` for standard input
    scene: PathBuf,
    /// Tell how this formula is read; may be repeated
    #[arg(long, allow_hyphen_values = true)]
    formula: Vec<String>,
    /// Typeset this symbol, given in LaTeX; may be repeated
    #[arg(long, allow_hyphen_values = true)]
    symbol: Vec<String>,
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
    let text = files::read(&args.scene, scene::LONGEST)?;
    let (description, is_read) = serve::describe(&text, &args.formula, &args.symbol);
    print(&pretty(&description))?;
    Ok(if is_read { 0 } else { 2 })
}
