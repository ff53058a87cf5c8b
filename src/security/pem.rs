//! Certificates and keys as files hold them: PEM (RFC 7468).

use std::fmt;

use rustls::pki_types::pem::PemObject as _;
use rustls::pki_types::{CertificateDer, PrivateKeyDer};

/// The text of a PEM file and what to call it. A key in it does not print itself.
#[derive(Clone)]
pub struct Pem {
    name: String,
    text: Vec<u8>,
}

impl fmt::Debug for Pem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Pem({:?}, …)", self.name)
    }
}

/// A file that does not hold what it should, or things that do not fit together.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PemError {
    #[error("{name} holds no certificate: expected PEM text with -----BEGIN CERTIFICATE-----")]
    NoCertificate { name: String },
    #[error("{name} holds no private key: expected PEM text with -----BEGIN PRIVATE KEY-----, not encrypted")]
    NoKey { name: String },
    #[error("{name} cannot be read as PEM text: {reason}")]
    Malformed { name: String, reason: String },
    #[error("the certificate in {name} cannot be used: {reason}")]
    Unusable { name: String, reason: String },
    #[error("{key} is not the private key of the certificate in {certificate}: give the two that belong together")]
    Mismatch { certificate: String, key: String },
    #[error("no certificate authority is trusted: this machine has none installed; name one with --ca FILE")]
    NobodyTrusted,
}

impl Pem {
    /// `text`, the contents of the file `name`.
    pub fn new(name: impl Into<String>, text: Vec<u8>) -> Pem {
        Pem { name: name.into(), text }
    }

    /// What to call it.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its certificates, at least one, in order.
    pub(super) fn certificates(&self) -> Result<Vec<CertificateDer<'static>>, PemError> {
        let read: Result<Vec<_>, _> = CertificateDer::pem_slice_iter(&self.text).collect();
        let certificates = read.map_err(|error| self.malformed(&error))?;
        match certificates.is_empty() {
            true => Err(PemError::NoCertificate { name: self.name.clone() }),
            false => Ok(certificates),
        }
    }

    /// Its first private key.
    pub(super) fn key(&self) -> Result<PrivateKeyDer<'static>, PemError> {
        PrivateKeyDer::from_pem_slice(&self.text).map_err(|error| match error {
            rustls::pki_types::pem::Error::NoItemsFound => PemError::NoKey { name: self.name.clone() },
            error => self.malformed(&error),
        })
    }

    fn malformed(&self, error: &rustls::pki_types::pem::Error) -> PemError {
        PemError::Malformed { name: self.name.clone(), reason: error.to_string() }
    }

    /// That rustls did not take a certificate in this file, whose key is in `key`.
    pub(super) fn unusable(&self, key: &Pem, error: &rustls::Error) -> PemError {
        match error {
            rustls::Error::InconsistentKeys(_) => {
                PemError::Mismatch { certificate: self.name.clone(), key: key.name.clone() }
            }
            error => PemError::Unusable { name: self.name.clone(), reason: error.to_string() },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_that_hold_something_else_are_told_by_name() {
        let pem = Pem::new("notes.txt", b"no PEM at all".to_vec());
        assert_eq!(
            pem.certificates().expect_err("none").to_string().split(':').next(),
            Some("notes.txt holds no certificate")
        );
        assert_eq!(pem.key().expect_err("none").to_string().split(':').next(), Some("notes.txt holds no private key"));
        let broken = Pem::new("cut.pem", b"-----BEGIN CERTIFICATE-----\nAAAA".to_vec());
        assert!(broken.certificates().expect_err("cut").to_string().starts_with("cut.pem cannot be read"), "cut");
        assert!(!format!("{broken:?}").contains("AAAA"), "it may be a key");
    }
}
