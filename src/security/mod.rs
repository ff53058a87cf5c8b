//! Who may speak with whom, and unheard by others: TLS with certificates of both sides, and bearer tokens.
//!
//! Certificates and keys come as PEM text that somebody else has read from a file; nothing here opens one, but for the
//! authorities that the operating system trusts. A token never prints itself, and neither does a key: they may stand in
//! settings that are logged.

mod client;
mod pem;
mod server;
mod stream;
mod token;

pub use client::{ClientTls, explain};
pub use pem::{Pem, PemError};
pub use server::ServerTls;
pub use stream::Stream;
pub use token::{BadToken, Token};
