//! The client's half of TLS: whom it trusts, and what it shows of itself.

use std::io;
use std::sync::Arc;

use rustls::pki_types::ServerName;
use rustls::{AlertDescription, CertificateError, ClientConfig, Error, RootCertStore};
use tokio::net::TcpStream;
use tokio_rustls::TlsConnector;

use super::{Pem, PemError, Stream};

/// What a server that expects something else than TLS does, or one that is just going down.
const HUNG_UP: &str = "the server hung up during the TLS handshake; write ws:// where it speaks plainly";

/// How a client makes TLS connections (TLS 1.2 and 1.3). The server's certificate is always checked.
#[derive(Clone, Debug)]
pub struct ClientTls(Arc<ClientConfig>);

impl ClientTls {
    /// Trusts the authorities in `authorities`, or where there is none those that the operating system trusts, and
    /// shows `identity` (a certificate chain and its key) to a server that asks for one.
    pub fn new(authorities: Option<&Pem>, identity: Option<(&Pem, &Pem)>) -> Result<ClientTls, PemError> {
        let provider = Arc::new(rustls::crypto::ring::default_provider());
        let config = ClientConfig::builder_with_provider(provider).with_safe_default_protocol_versions();
        let config =
            config.expect("ring has the suites of TLS 1.2 and 1.3").with_root_certificates(roots(authorities)?);
        let config = match identity {
            None => config.with_no_client_auth(),
            Some((chain, key)) => config
                .with_client_auth_cert(chain.certificates()?, key.key()?)
                .map_err(|error| chain.unusable(key, &error))?,
        };
        Ok(ClientTls(Arc::new(config)))
    }

    /// Makes the TLS handshake on `stream` with the server called `host`, a name or an address.
    pub async fn connect(&self, host: &str, stream: TcpStream) -> io::Result<Stream> {
        let name = ServerName::try_from(host.to_owned()).map_err(io::Error::other)?;
        let tls = TlsConnector::from(Arc::clone(&self.0)).connect(name, stream).await.map_err(|error| {
            match error.kind() {
                io::ErrorKind::UnexpectedEof => io::Error::other(HUNG_UP),
                _ => error,
            }
        })?;
        Ok(Stream::Tls(Box::new(tls.into())))
    }
}

/// Those whose signature under a server's certificate counts.
pub(super) fn roots(authorities: Option<&Pem>) -> Result<RootCertStore, PemError> {
    let mut roots = RootCertStore::empty();
    match authorities {
        Some(pem) => {
            for certificate in pem.certificates()? {
                let unusable =
                    |error: Error| PemError::Unusable { name: pem.name().to_owned(), reason: error.to_string() };
                roots.add(certificate).map_err(unusable)?;
            }
        }
        // One that the system holds and rustls cannot read is none to trust; others still are.
        None => _ = roots.add_parsable_certificates(rustls_native_certs::load_native_certs().certs),
    }
    if roots.is_empty() { Err(PemError::NobodyTrusted) } else { Ok(roots) }
}

/// What a failure of TLS within `error` means to a client's people, and what to do; `None` where TLS is not to blame.
pub fn explain(error: &io::Error) -> Option<String> {
    let error = error.get_ref()?.downcast_ref::<Error>()?;
    let alert = |alert: &AlertDescription| match alert {
        AlertDescription::CertificateRequired => {
            "the server demands a client certificate: give --cert FILE and --key FILE".to_owned()
        }
        AlertDescription::UnknownCA
        | AlertDescription::BadCertificate
        | AlertDescription::CertificateUnknown
        | AlertDescription::CertificateExpired
        | AlertDescription::CertificateRevoked
        | AlertDescription::DecryptError
        | AlertDescription::AccessDenied => {
            format!(
                "the server does not accept our client certificate ({alert:?}): give one that it trusts with --cert FILE"
            )
        }
        alert => format!("the server ended the TLS handshake: {alert:?}"),
    };
    Some(match error {
        Error::InvalidCertificate(error) => format!("the server's certificate is refused: {}", certificate(error)),
        Error::AlertReceived(description) => alert(description),
        Error::InvalidMessage(_) => {
            "the server does not speak TLS there: write ws:// where it speaks plainly".to_owned()
        }
        error => format!("the TLS handshake failed: {error}"),
    })
}

fn certificate(error: &CertificateError) -> String {
    match error {
        CertificateError::UnknownIssuer => {
            "nobody that is trusted here signed it; name its authority with --ca FILE".to_owned()
        }
        CertificateError::Expired | CertificateError::ExpiredContext { .. } => "it has expired".to_owned(),
        CertificateError::NotValidYet | CertificateError::NotValidYetContext { .. } => {
            "it is not valid yet; is the clock of this machine right?".to_owned()
        }
        CertificateError::NotValidForName | CertificateError::NotValidForNameContext { .. } => {
            format!("it is for another host; {error}")
        }
        CertificateError::BadSignature => "its signature is wrong; name its authority with --ca FILE".to_owned(),
        error => error.to_string(),
    }
}
