//! The page: built from `view/` beforehand and carried in the program.
//!
//! A path is looked up in a table and never on a disk: there is nothing to climb out of.

use axum::extract::Path;
use axum::http::HeaderMap;
use axum::http::StatusCode;
use axum::http::header::{
    CACHE_CONTROL, CONTENT_SECURITY_POLICY, CONTENT_TYPE, ETAG, HeaderName, HeaderValue, IF_NONE_MATCH,
    REFERRER_POLICY, X_CONTENT_TYPE_OPTIONS,
};
use axum::response::{IntoResponse, Response};

use super::answer::Refusal;

/// Name, type, content.
const FILES: &[(&str, &str, &[u8])] = &[
    ("index.html", "text/html; charset=utf-8", include_bytes!("../../view/dist/index.html")),
    ("assets/app.js", "text/javascript; charset=utf-8", include_bytes!("../../view/dist/assets/app.js")),
    ("assets/app.css", "text/css; charset=utf-8", include_bytes!("../../view/dist/assets/app.css")),
    ("assets/icon.svg", "image/svg+xml", include_bytes!("../../view/dist/assets/icon.svg")),
];

/// Nothing but what this server serves; the report's page has its style within it.
const POLICY: &str = "default-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; \
                      frame-ancestors 'self'; base-uri 'none'; form-action 'none'; object-src 'none'";

/// `GET /`.
pub async fn index(headers: HeaderMap) -> Response {
    file("index.html", &headers)
}

/// `GET /assets/{file}`.
pub async fn asset(Path(name): Path<String>, headers: HeaderMap) -> Response {
    file(&format!("assets/{name}"), &headers)
}

fn file(name: &str, asked: &HeaderMap) -> Response {
    let Some((_, kind, content)) = FILES.iter().find(|(known, ..)| *known == name) else {
        return Refusal::absent(format!("there is no {name:?}"), "GET / is the page").into_response();
    };
    let tag = format!("\"{}-{:016x}\"", env!("CARGO_PKG_VERSION"), digest(content));
    let is_known = asked.get(IF_NONE_MATCH).is_some_and(|known| known.as_bytes() == tag.as_bytes());
    let mut response = match is_known {
        true => StatusCode::NOT_MODIFIED.into_response(),
        false => (*content).into_response(),
    };
    let headers = response.headers_mut();
    headers.insert(CONTENT_TYPE, HeaderValue::from_static(kind));
    headers.insert(CACHE_CONTROL, HeaderValue::from_static("no-cache"));
    if let Ok(tag) = HeaderValue::from_str(&tag) {
        headers.insert(ETAG, tag);
    }
    shield(headers);
    response
}

/// What a browser must not do with what this server serves.
pub fn shield(headers: &mut HeaderMap) {
    let fixed: [(HeaderName, &'static str); 3] =
        [(CONTENT_SECURITY_POLICY, POLICY), (X_CONTENT_TYPE_OPTIONS, "nosniff"), (REFERRER_POLICY, "no-referrer")];
    for (name, value) in fixed {
        headers.insert(name, HeaderValue::from_static(value));
    }
}

/// FNV-1a, 64 bits: to tell builds of a file apart, not against anyone who means harm.
fn digest(content: &[u8]) -> u64 {
    content
        .iter()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_is_in_the_table_is_served() {
        let check =
            |name: &str, status: u16| assert_eq!(file(name, &HeaderMap::new()).status().as_u16(), status, "{name}");
        check("index.html", 200);
        check("assets/app.js", 200);
        for name in
            ["../Cargo.toml", "assets/../../Cargo.toml", "/etc/passwd", "assets/", "", "assets/app.js/..", "%2e%2e/x"]
        {
            check(name, 404);
        }
    }
}
