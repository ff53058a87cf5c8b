//! Certificates, keys and tokens, read from their files.

use std::path::Path;

use kinetwin::security::{Pem, ServerTls, Token};

use super::Arguments;

/// How the server speaks TLS, where it does.
pub fn tls(arguments: &Arguments) -> Result<Option<ServerTls>, String> {
    let Some((cert, key)) = arguments.cert.as_deref().zip(arguments.key.as_deref()) else { return Ok(None) };
    let authority = arguments.client_ca.as_deref().map(read).transpose()?;
    ServerTls::new(&read(cert)?, &read(key)?, authority.as_ref()).map(Some).map_err(|error| error.to_string())
}

/// The token that a client has to show, where it has to.
pub fn token(arguments: &Arguments) -> Result<Option<Token>, String> {
    let Some(path) = &arguments.token_file else { return Ok(None) };
    let name = path.display();
    let text = std::fs::read_to_string(path).map_err(|error| format!("failed to read {name}: {error}"))?;
    Token::new(&text).map(Some).map_err(|error| format!("{name}: {error}"))
}

fn read(path: &Path) -> Result<Pem, String> {
    let name = path.display().to_string();
    let text = std::fs::read(path).map_err(|error| format!("failed to read {name}: {error}"))?;
    Ok(Pem::new(name, text))
}
