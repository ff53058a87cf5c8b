//! Certificates, keys and tokens: read from files or the environment, never from an argument that `ps` would show.

use std::path::Path;

use super::Failure;
use super::arguments::ConnectionArguments;
use crate::run::Connect;
use crate::security::{ClientTls, Pem, Token};

/// The bearer token: from the file that is named, else from the environment.
pub fn token(connection: &ConnectionArguments) -> Result<Option<Token>, Failure> {
    let (from, text) = match &connection.token_file {
        Some(path) => {
            let read = std::fs::read_to_string(path);
            let failed = |error| Failure(format!("error: failed to read the token from {}: {error}", path.display()));
            (path.display().to_string(), read.map_err(failed)?)
        }
        None => match std::env::var("KINETWIN_TOKEN") {
            Ok(text) => ("KINETWIN_TOKEN".to_owned(), text),
            Err(_) => return Ok(None),
        },
    };
    Token::new(&text).map(Some).map_err(|error| Failure(format!("error: {from}: {error}")))
}

/// How a `wss://` server is reached; `None` for another. Certificates for a connection without TLS are a mistake.
pub fn tls(connection: &ConnectionArguments) -> Result<Option<ClientTls>, Failure> {
    let is_secure = matches!(&connection.connect, Some(Connect::Server(endpoint)) if endpoint.is_secure());
    if !is_secure {
        let given =
            [("--ca", &connection.ca), ("--cert", &connection.cert)].into_iter().find(|(_, path)| path.is_some());
        return match given {
            None => Ok(None),
            Some((option, _)) => Err(Failure(format!(
                "error: {option} is for an encrypted connection: give --connect wss://HOST:PORT with it"
            ))),
        };
    }
    let ca = connection.ca.as_deref().map(read).transpose()?;
    let cert = connection.cert.as_deref().map(read).transpose()?;
    let key = connection.key.as_deref().map(read).transpose()?;
    let tls = ClientTls::new(ca.as_ref(), cert.as_ref().zip(key.as_ref()));
    tls.map(Some).map_err(|error| Failure(format!("error: {error}")))
}

fn read(path: &Path) -> Result<Pem, Failure> {
    let name = path.display().to_string();
    let text = std::fs::read(path).map_err(|error| Failure(format!("error: failed to read {name}: {error}")))?;
    Ok(Pem::new(name, text))
}
