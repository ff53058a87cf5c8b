//! The server's half of TLS: what it shows of itself, and whom it lets in.

use std::io;
use std::sync::Arc;

use rustls::ServerConfig;
use rustls::server::WebPkiClientVerifier;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::TcpStream;
use tokio_rustls::TlsAcceptor;

use super::client::roots;
use super::{Pem, PemError, Stream};

/// How a server takes TLS connections (TLS 1.2 and 1.3).
#[derive(Clone, Debug)]
pub struct ServerTls(Arc<ServerConfig>);

impl ServerTls {
    /// Shows the certificate chain in `chain` with its `key`; where there are `authorities`, only clients with a
    /// certificate that one of them signed are let in.
    pub fn new(chain: &Pem, key: &Pem, authorities: Option<&Pem>) -> Result<ServerTls, PemError> {
        let provider = Arc::new(rustls::crypto::ring::default_provider());
        let config = ServerConfig::builder_with_provider(Arc::clone(&provider)).with_safe_default_protocol_versions();
        let config = config.expect("ring has the suites of TLS 1.2 and 1.3");
        let config = match authorities {
            None => config.with_no_client_auth(),
            Some(pem) => {
                let unusable = |error: &dyn std::error::Error| PemError::Unusable {
                    name: pem.name().to_owned(),
                    reason: error.to_string(),
                };
                let roots = Arc::new(roots(Some(pem))?);
                let verifier = WebPkiClientVerifier::builder_with_provider(roots, provider).build();
                config.with_client_cert_verifier(verifier.map_err(|error| unusable(&error))?)
            }
        };
        let config = config.with_single_cert(chain.certificates()?, key.key()?);
        Ok(ServerTls(Arc::new(config.map_err(|error| chain.unusable(key, &error))?)))
    }

    /// Makes the TLS handshake with the client at the other end of `stream`.
    pub async fn accept(&self, stream: TcpStream) -> io::Result<Stream> {
        match TlsAcceptor::from(Arc::clone(&self.0)).accept(stream).into_fallible().await {
            Ok(tls) => Ok(Stream::Tls(Box::new(tls.into()))),
            Err((error, stream)) => {
                hang_up(stream).await;
                Err(error)
            }
        }
    }
}

/// Lets the client read why: with what it still sends unread, the operating system would reset the connection and throw
/// the alert away. The caller bounds the time.
async fn hang_up(mut stream: TcpStream) {
    let mut scrap = [0; 4096];
    if stream.shutdown().await.is_ok() {
        while matches!(stream.read(&mut scrap).await, Ok(1..)) {}
    }
}
