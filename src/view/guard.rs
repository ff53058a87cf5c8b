//! Who may ask for what: no web page that a user happens to visit can move the plant.
//!
//! - **Host**: a name that is not ours is refused, whatever it resolves to. A page of another site that lets its own name
//!   point to this machine (DNS rebinding) sends its own name.
//! - **Origin**: where a browser says which page asks, it has to be ours; that holds for the stream, too, which no
//!   same-origin policy protects. `Sec-Fetch-Site` is asked as well, where there is one.
//! - **Token**: beyond the loopback interface, whoever writes shows the run's token as a bearer's. It is printed with the
//!   address, behind the `#`, which no browser sends on.

use std::net::{IpAddr, SocketAddr};
use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::header::{AUTHORIZATION, HOST, HeaderMap, ORIGIN};
use axum::http::{HeaderName, Method, StatusCode};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use super::answer::Refusal;

/// What a request has to show.
#[derive(Clone, Debug)]
pub struct Guard {
    address: SocketAddr,
    /// `None` on the loopback interface.
    token: Option<String>,
}

const SEC_FETCH_SITE: HeaderName = HeaderName::from_static("sec-fetch-site");

impl Guard {
    /// The guard of what listens at `address`. `token` is asked for beyond the loopback interface; without one, one is made
    /// up.
    pub fn new(address: SocketAddr, token: Option<String>) -> Guard {
        let made_up = || uuid::Uuid::new_v4().simple().to_string();
        let token = (!address.ip().is_loopback()).then(|| token.unwrap_or_else(made_up));
        Guard { address, token }
    }

    /// The address for people; the token is in it.
    pub fn url(&self) -> String {
        let token = self.token.as_ref().map(|token| format!("#token={token}")).unwrap_or_default();
        format!("http://{}/{token}", self.address)
    }

    /// Whether writing needs a token.
    pub fn needs_token(&self) -> bool {
        self.token.is_some()
    }

    fn check(&self, method: &Method, headers: &HeaderMap) -> Result<(), Refusal> {
        let text = |name: &HeaderName| headers.get(name).and_then(|value| value.to_str().ok());
        let forbidden = |error: String, hint: &str| Err(Refusal::new(StatusCode::FORBIDDEN, error, hint));
        let Some(host) = text(&HOST).filter(|_| headers.get_all(HOST).iter().count() == 1) else {
            return Err(Refusal::malformed("the request names no host", "send one Host header"));
        };
        if !self.is_ours(host) {
            return forbidden(
                format!("{host:?} is no name of this server"),
                "use the address that was printed when the program started",
            );
        }
        if let Some(origin) = headers.get(ORIGIN)
            && origin.to_str().ok().and_then(|origin| origin.strip_prefix("http://")) != Some(host)
        {
            return forbidden(
                format!("a page of {origin:?} may not ask this server"),
                "open the page that this server serves, or leave Origin out where no browser asks",
            );
        }
        let is_foreign = text(&SEC_FETCH_SITE).is_some_and(|site| !["same-origin", "none"].contains(&site));
        // Following a link to the page is no harm.
        if is_foreign
            && !(method == Method::GET && text(&HeaderName::from_static("sec-fetch-mode")) == Some("navigate"))
        {
            return forbidden("another site's page may not ask this server".to_owned(), "open this server's own page");
        }
        let reads = [Method::GET, Method::HEAD, Method::OPTIONS].contains(method);
        match &self.token {
            Some(token) if !reads && !shows(headers, token) => Err(Refusal::new(
                StatusCode::UNAUTHORIZED,
                "this needs the run's token, because the server listens beyond this machine",
                "send Authorization: Bearer TOKEN; the token was printed with the address when the program started",
            )),
            _ => Ok(()),
        }
    }

    /// Whether a Host header names this server: by an IP address, which no foreign name service can make up, or as localhost
    /// where it listens there.
    fn is_ours(&self, host: &str) -> bool {
        let (name, port) = match host.rsplit_once(':').filter(|(_, port)| port.chars().all(|c| c.is_ascii_digit())) {
            Some((name, port)) => (name, port.parse().unwrap_or(0)),
            None => (host, 80),
        };
        let address = name.trim_start_matches('[').trim_end_matches(']').parse::<IpAddr>();
        let ip = self.address.ip();
        let is_named = match address {
            Ok(address) if ip.is_loopback() => address.is_loopback(),
            Ok(address) => ip.is_unspecified() || address == ip,
            Err(_) => name.eq_ignore_ascii_case("localhost") && (ip.is_loopback() || ip.is_unspecified()),
        };
        is_named && port == self.address.port()
    }
}

/// Whether the headers show `token`. How long it takes does not say how much of it is right.
fn shows(headers: &HeaderMap, token: &str) -> bool {
    let shown = headers.get(AUTHORIZATION).and_then(|value| value.to_str().ok()).unwrap_or_default();
    let shown = shown.strip_prefix("Bearer ").unwrap_or_default().as_bytes();
    let differing = shown.iter().zip(token.as_bytes()).fold(0, |differing, (a, b)| differing | (a ^ b));
    shown.len() == token.len() && differing == 0
}

/// Lets a request through, or answers why not.
pub async fn watch(State(guard): State<Arc<Guard>>, request: Request, next: Next) -> Response {
    match guard.check(request.method(), request.headers()) {
        Ok(()) => next.run(request).await,
        Err(refusal) => refusal.into_response(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn headers(given: &[(&'static str, &str)]) -> HeaderMap {
        let one =
            |(name, value): &(&'static str, &str)| (HeaderName::from_static(name), value.parse().expect("a value"));
        given.iter().map(one).collect()
    }

    #[track_caller]
    fn check(address: &str, method: Method, given: &[(&'static str, &str)], expected: u16) {
        let guard = Guard::new(address.parse().expect("an address"), Some("secret".to_owned()));
        let found = guard.check(&method, &headers(given)).map_or_else(|refusal| refusal.status.as_u16(), |()| 200);
        assert_eq!(found, expected, "{address} {method} {given:?}");
    }

    #[test]
    fn a_name_that_is_not_ours_is_refused() {
        for host in ["127.0.0.1:8100", "localhost:8100", "[::1]:8100"] {
            check("127.0.0.1:8100", Method::POST, &[("host", host)], 200);
        }
        for host in
            ["evil.example:8100", "127.0.0.1", "127.0.0.1:81", "192.168.0.7:8100", "localhost.evil.example:8100", ""]
        {
            check("127.0.0.1:8100", Method::GET, &[("host", host)], 403);
        }
        check("127.0.0.1:8100", Method::GET, &[], 400);
        check("0.0.0.0:8100", Method::GET, &[("host", "192.168.0.7:8100")], 200);
        check("0.0.0.0:8100", Method::GET, &[("host", "evil.example:8100")], 403);
        check("192.168.0.7:8100", Method::GET, &[("host", "192.168.0.8:8100")], 403);
    }

    #[test]
    fn a_foreign_page_is_refused() {
        let host = ("host", "127.0.0.1:8100");
        let at = "127.0.0.1:8100";
        check(at, Method::POST, &[host, ("origin", "http://127.0.0.1:8100")], 200);
        for origin in ["http://evil.example", "null", "https://127.0.0.1:8100", "http://127.0.0.1:81"] {
            check(at, Method::POST, &[host, ("origin", origin)], 403);
            check(at, Method::GET, &[host, ("origin", origin)], 403);
        }
        check(at, Method::GET, &[host, ("sec-fetch-site", "cross-site")], 403);
        check(at, Method::GET, &[host, ("sec-fetch-site", "cross-site"), ("sec-fetch-mode", "navigate")], 200);
        check(at, Method::POST, &[host, ("sec-fetch-site", "cross-site"), ("sec-fetch-mode", "navigate")], 403);
        check(at, Method::POST, &[host, ("sec-fetch-site", "same-origin")], 200);
    }

    #[test]
    fn beyond_this_machine_writing_needs_the_token() {
        let host = ("host", "192.168.0.7:8100");
        let at = "192.168.0.7:8100";
        check(at, Method::GET, &[host], 200);
        check(at, Method::POST, &[host], 401);
        check(at, Method::POST, &[host, ("authorization", "Bearer secreT")], 401);
        check(at, Method::POST, &[host, ("authorization", "Bearer secretsecret")], 401);
        check(at, Method::POST, &[host, ("authorization", "secret")], 401);
        check(at, Method::POST, &[host, ("authorization", "Bearer secret")], 200);
        assert!(Guard::new(at.parse().expect("an address"), None).url().contains("#token="));
        assert!(!Guard::new("127.0.0.1:1".parse().expect("an address"), None).needs_token());
    }
}
