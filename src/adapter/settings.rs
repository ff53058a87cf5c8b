//! How a connector is set up.

use std::time::Duration;

use super::Endpoint;
use crate::security::{ClientTls, Token};
use crate::session::Limits;
use crate::wire::SignalSelection;

/// The settings of a connector: those of the reference (host, port, timeout, signals map; section 5.3.2.3) and ours.
///
/// The signals map is handed to [`init`](super::Adapter::init), read.
#[derive(Clone, Debug)]
pub struct Settings {
    /// Host and port of the automation; not looked at by a connector within the process.
    pub endpoint: Endpoint,
    /// How long a connection may take to open, and an answer to come.
    pub timeout: Duration,
    /// The longest message that is taken in, bytes.
    pub max_message: usize,
    /// How many values a message may bring, and how many messages a second may.
    pub limits: Limits,
    /// The signals that the automation is to send, and how often at most; `None` for all, at every change.
    pub signals: Option<Vec<SignalSelection>>,
    /// Who connects: the same for all connections of one run, unique across runs.
    pub id: String,
    /// Sent as `Authorization: Bearer …` with the WebSocket handshake.
    pub token: Option<Token>,
    /// How a `wss://` endpoint is reached; without it, only `ws://` is.
    pub tls: Option<ClientTls>,
}

impl Settings {
    /// The longest message that is taken in where nobody says otherwise: 1 MiB.
    pub const MAX_MESSAGE: usize = 1 << 20;

    /// Settings for `endpoint` under the name `id`, with the protocol's limits.
    pub fn new(endpoint: Endpoint, id: impl Into<String>) -> Settings {
        let timeout = Duration::from_secs(5);
        Settings {
            endpoint,
            timeout,
            max_message: Settings::MAX_MESSAGE,
            limits: Limits::default(),
            signals: None,
            id: id.into(),
            token: None,
            tls: None,
        }
    }
}

/// Settings that cannot work.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SettingsError {
    #[error("a timeout of zero leaves no time for any answer: expected a duration as 5s")]
    NoTimeout,
    #[error(
        "the longest message would be {found} bytes: expected at least {}, room for one value with its name",
        Settings::LEAST_MESSAGE
    )]
    MessageTooShort { found: usize },
    #[error("{0} is to be reached over TLS, and nothing says whom to trust: expected settings for TLS")]
    NoTls(Endpoint),
}

impl Settings {
    /// The least that `max_message` may be, bytes: room for one value with its name.
    pub const LEAST_MESSAGE: usize = 1024;

    /// Refuses settings that cannot work.
    pub fn validate(&self) -> Result<(), SettingsError> {
        if self.timeout.is_zero() {
            return Err(SettingsError::NoTimeout);
        }
        if self.max_message < Settings::LEAST_MESSAGE {
            return Err(SettingsError::MessageTooShort { found: self.max_message });
        }
        if self.endpoint.is_secure() && self.tls.is_none() {
            return Err(SettingsError::NoTls(self.endpoint.clone()));
        }
        Ok(())
    }
}
