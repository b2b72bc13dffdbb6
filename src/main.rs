//! The command line of carom: reads files, calls the library, prints, and turns outcomes into exit codes.

mod cli;

fn main() -> std::process::ExitCode {
    cli::run()
}
