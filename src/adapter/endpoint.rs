//! Where an automation listens: `ws://HOST:PORT`, or encrypted `wss://HOST:PORT`.

use std::fmt;
use std::str::FromStr;

/// The address of a server, as a `--connect` option gives it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Endpoint {
    is_secure: bool,
    host: String,
    port: u16,
    path: String,
}

/// A text that is no address of a server.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParseEndpointError {
    #[error("{found:?} is no address of a server: expected ws://HOST:PORT or wss://HOST:PORT, as ws://127.0.0.1:8080")]
    Malformed { found: String },
    #[error("{found:?} names no port: write ws://HOST:PORT, as ws://127.0.0.1:8080")]
    NoPort { found: String },
}

impl Endpoint {
    /// The server at `host` and `port`, unencrypted, without a path. An IPv6 address stands without brackets.
    pub fn new(host: impl Into<String>, port: u16) -> Endpoint {
        Endpoint { is_secure: false, host: host.into(), port, path: String::new() }
    }

    /// The host's name or address, an IPv6 address without its brackets.
    pub fn host(&self) -> &str {
        &self.host
    }

    /// Whether it is to be reached over TLS.
    pub fn is_secure(&self) -> bool {
        self.is_secure
    }

    /// The port.
    pub fn port(&self) -> u16 {
        self.port
    }
}

impl FromStr for Endpoint {
    type Err = ParseEndpointError;

    fn from_str(text: &str) -> Result<Endpoint, ParseEndpointError> {
        let found = || text.to_owned();
        let malformed = || ParseEndpointError::Malformed { found: found() };
        let (is_secure, rest) = match text.split_once("://") {
            Some(("ws", rest)) => (false, rest),
            Some(("wss", rest)) => (true, rest),
            _ => return Err(malformed()),
        };
        let (authority, path) = rest.find('/').map_or((rest, ""), |at| rest.split_at(at));
        // The brackets of an IPv6 address keep its colons apart from the port's.
        let (host, port) = match authority.strip_prefix('[') {
            Some(bracketed) => {
                let (host, port) = bracketed.split_once(']').ok_or_else(malformed)?;
                (host, port.strip_prefix(':'))
            }
            None => authority.rsplit_once(':').map_or((authority, None), |(host, port)| (host, Some(port))),
        };
        let plain = |c: char| c.is_ascii_graphic() && !matches!(c, '@' | '?' | '#' | '[' | ']');
        if host.is_empty() || !host.chars().all(plain) || !path.chars().all(|c| c.is_ascii_graphic()) {
            return Err(malformed());
        }
        let port = port.ok_or_else(|| ParseEndpointError::NoPort { found: found() })?;
        let port = port.parse().ok().filter(|&port: &u16| port != 0).ok_or_else(malformed)?;
        Ok(Endpoint { is_secure, host: host.to_owned(), port, path: path.to_owned() })
    }
}

impl fmt::Display for Endpoint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let scheme = if self.is_secure { "wss" } else { "ws" };
        if self.host.contains(':') {
            write!(f, "{scheme}://[{}]:{}{}", self.host, self.port, self.path)
        } else {
            write!(f, "{scheme}://{}:{}{}", self.host, self.port, self.path)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, host: &str, port: u16) {
        let endpoint: Endpoint = text.parse().expect(text);
        assert_eq!((endpoint.host(), endpoint.port()), (host, port), "{text}");
        assert_eq!(endpoint.to_string(), text);
    }

    #[test]
    fn addresses_read_and_write() {
        check("ws://127.0.0.1:8080", "127.0.0.1", 8080);
        check("ws://plc.example:80/cps?x=1", "plc.example", 80);
        check("ws://[::1]:8080", "::1", 8080);
        check("wss://plc.example:443/cps", "plc.example", 443);
        assert!("wss://[::1]:443".parse::<Endpoint>().expect("secure").is_secure());
        assert_eq!(Endpoint::new("localhost", 99).to_string(), "ws://localhost:99");
    }

    #[test]
    fn what_is_no_address_is_refused_in_words() {
        for text in [
            "",
            "localhost:80",
            "http://a:80",
            "ws://",
            "ws://:80",
            "ws://a:0",
            "ws://a:66000",
            "ws://a b:1",
            "ws://[::1:80",
        ] {
            let error = text.parse::<Endpoint>().expect_err(text).to_string();
            assert!(error.contains("expected ws://HOST:PORT"), "{error}");
        }
        let error = "ws://localhost".parse::<Endpoint>().expect_err("no port").to_string();
        assert!(error.contains("names no port"), "{error}");
    }
}
