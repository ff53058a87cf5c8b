//! R012: encrypted connections, certificates of both sides, bearer tokens; what is wrong is refused in words, and no secret
//! is ever told. The peer is the automation's server; its certificates are made here, at every run.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use kinetwin::automation::program::map_of;
use kinetwin::automation::server::{ListenSettings, Server};
use kinetwin::automation::{Automation, Control, Faulty};
use kinetwin::security::{Pem, ServerTls, Token};
use rcgen::{BasicConstraints, CertificateParams, CertifiedIssuer, IsCa, KeyPair, date_time_ymd};
use tempfile::TempDir;

use crate::support::{Ended, Host, Running, kinetwin};

/// A folder with an authority that signs certificates.
struct Authority {
    folder: TempDir,
    issuer: CertifiedIssuer<'static, KeyPair>,
}

impl Authority {
    fn new() -> Authority {
        let mut parameters = CertificateParams::new(Vec::new()).expect("no names");
        parameters.is_ca = IsCa::Ca(BasicConstraints::Unconstrained);
        let issuer =
            CertifiedIssuer::self_signed(parameters, KeyPair::generate().expect("a key")).expect("an authority");
        let authority = Authority { folder: tempfile::tempdir().expect("a folder"), issuer };
        authority.write("ca.pem", &authority.issuer.as_ref().pem());
        authority
    }

    fn write(&self, name: &str, text: &str) -> PathBuf {
        let path = self.folder.path().join(name);
        fs::write(&path, text).expect("a file");
        path
    }

    /// The path of a file in its folder.
    fn path(&self, name: &str) -> String {
        self.folder.path().join(name).to_str().expect("UTF-8").to_owned()
    }

    /// Writes NAME.pem, a certificate for `host`, and NAME.key.
    fn sign(&self, name: &str, host: &str) {
        self.sign_until(name, host, 2999);
    }

    fn sign_until(&self, name: &str, host: &str, year: i32) {
        let key = KeyPair::generate().expect("a key");
        let mut parameters = CertificateParams::new([host.to_owned()]).expect("a name");
        parameters.not_after = date_time_ymd(year, 1, 1);
        let certificate = parameters.signed_by(&key, &self.issuer).expect("a certificate");
        self.write(&format!("{name}.pem"), &certificate.pem());
        self.write(&format!("{name}.key"), &key.serialize_pem());
    }

    fn pem(&self, name: &str) -> Pem {
        read(&self.folder.path().join(name))
    }

    /// A server on this machine that shows the certificate called `name`.
    fn serve(&self, name: &str, clients: Option<&Authority>, token: Option<&str>) -> Served {
        let clients = clients.map(|authority| authority.pem("ca.pem"));
        let (chain, key) = (self.pem(&format!("{name}.pem")), self.pem(&format!("{name}.key")));
        let tls = ServerTls::new(&chain, &key, clients.as_ref()).expect("certificates that fit");
        let token = token.map(|token| Token::new(token).expect("a token"));
        serve(ListenSettings { tls: Some(tls), token, ..ListenSettings::loopback() }, "wss")
    }
}

fn read(path: &Path) -> Pem {
    Pem::new(path.display().to_string(), fs::read(path).expect("a file"))
}

struct Served {
    url: String,
    _server: Server,
}

fn serve(settings: ListenSettings, scheme: &str) -> Served {
    let map = map_of("rig").expect("the rig's map");
    let automation = Automation::new(Arc::clone(&map), Control::ByPlant).expect("the rig's automation");
    let server = Server::start(settings, Faulty::new(automation, &[], 0)).expect("a server");
    Served { url: format!("{scheme}://{}", server.address()), _server: server }
}

fn ask(served: &Served, more: &[&str]) -> Ended {
    kinetwin(&[&["check", "models/rig", "--connect", &served.url], more].concat())
}

/// That both commands let themselves be told `why`, with exit code 2.
#[track_caller]
fn refused(served: &Served, more: &[&str], why: &str) {
    let asked = ask(served, more);
    assert!(asked.stderr.contains(why), "{}", asked.stderr);
    assert_eq!((asked.code(), asked.stdout.as_str()), (2, ""));
    let run = kinetwin(&[&["run", "models/rig", "--connect", &served.url, "--for", "60s"], more].concat());
    assert!(run.stderr.contains(&format!("error: failed to connect to {}: ", served.url)), "{}", run.stderr);
    assert!(run.stderr.contains(why), "{}", run.stderr);
    assert_eq!(run.code(), 2, "it ended for it, long before its 60 s");
}

#[test]
fn a_server_whose_certificate_is_signed_by_the_right_authority_is_spoken_with() {
    let authority = Authority::new();
    authority.sign("server", "127.0.0.1");
    let served = authority.serve("server", None, None);
    let ca = authority.path("ca.pem");
    let asked = ask(&served, &["--ca", &ca]);
    assert_eq!(asked.code(), 0, "{}", asked.stderr);
    assert!(asked.stdout.contains("all fits"), "{}", asked.stdout);
    let run = kinetwin(&["run", "models/rig", "--connect", &served.url, "--ca", &ca, "--for", "1s", "--json"]);
    assert_eq!(run.code(), 0, "{}", run.stderr);
    let summary = run.json();
    assert_eq!((&summary["sessions"], &summary["messages_lost"]), (&1.into(), &0.into()), "{summary}");
    assert!(summary["values_in"].as_u64() > Some(0) && summary["values_out"].as_u64() > Some(0), "{summary}");
}

#[test]
fn a_server_s_certificate_is_checked() {
    let (authority, other) = (Authority::new(), Authority::new());
    authority.sign("server", "127.0.0.1");
    authority.sign("elsewhere", "plc.example");
    authority.sign_until("old", "127.0.0.1", 2001);
    let ca = authority.path("ca.pem");
    let served = authority.serve("server", None, None);
    refused(&served, &["--ca", &other.path("ca.pem")], "name its authority with --ca FILE");
    refused(&authority.serve("elsewhere", None, None), &["--ca", &ca], "it is for another host");
    refused(&authority.serve("old", None, None), &["--ca", &ca], "it has expired");
}

#[test]
fn a_server_that_speaks_plainly_is_told_apart() {
    let authority = Authority::new();
    let plain = serve(ListenSettings::loopback(), "wss");
    let asked = ask(&plain, &["--ca", &authority.path("ca.pem")]);
    assert_eq!(asked.code(), 2);
    assert!(asked.stderr.contains("write ws:// where it speaks plainly"), "{}", asked.stderr);
}

#[test]
fn a_client_certificate_that_is_demanded_has_to_be_the_right_one() {
    let (authority, other) = (Authority::new(), Authority::new());
    authority.sign("server", "127.0.0.1");
    authority.sign("us", "kinetwin");
    other.sign("us", "kinetwin");
    let served = authority.serve("server", Some(&authority), None);
    let ca = authority.path("ca.pem");
    refused(&served, &["--ca", &ca], "the server demands a client certificate: give --cert FILE and --key FILE");
    let foreign = ["--ca", &ca, "--cert", &other.path("us.pem"), "--key", &other.path("us.key")];
    refused(&served, &foreign, "the server does not accept our client certificate");
    let ours = ["--ca", &ca, "--cert", &authority.path("us.pem"), "--key", &authority.path("us.key")];
    let asked = ask(&served, &ours);
    assert_eq!(asked.code(), 0, "{}", asked.stderr);
}

#[test]
fn a_token_that_is_demanded_has_to_be_the_right_one() {
    let authority = Authority::new();
    authority.sign("server", "127.0.0.1");
    authority.write("right", "opensesame\n");
    authority.write("wrong", "opensaysme\n");
    let served = authority.serve("server", None, Some("opensesame"));
    let (ca, right, wrong) = (authority.path("ca.pem"), authority.path("right"), authority.path("wrong"));
    let why = "give the right one with --token-file FILE or in KINETWIN_TOKEN (HTTP status 401)";
    refused(&served, &["--ca", &ca], why);
    refused(&served, &["--ca", &ca, "--token-file", &wrong], why);
    let asked = ask(&served, &["--ca", &ca, "--token-file", &right]);
    assert_eq!(asked.code(), 0, "{}", asked.stderr);
    let arguments = ["check", "models/rig", "--connect", &served.url, "--ca", &ca];
    let by_environment = Running::start_with(&arguments, &[("KINETWIN_TOKEN", "opensesame")]).end();
    assert_eq!(by_environment.code(), 0, "{}", by_environment.stderr);
    // Without TLS the token is asked for all the same.
    let token = Some(Token::new("opensesame").expect("a token"));
    let plain = serve(ListenSettings { token, ..ListenSettings::loopback() }, "ws");
    refused(&plain, &[], why);
    assert_eq!(ask(&plain, &["--token-file", &right]).code(), 0);
}

#[test]
fn no_secret_is_told_to_anyone() {
    let authority = Authority::new();
    authority.sign("server", "127.0.0.1");
    authority.sign("us", "kinetwin");
    let served = authority.serve("server", Some(&authority), Some("opensesame"));
    let key = fs::read_to_string(authority.path("us.key")).expect("a key");
    let secrets = ["opensesame", key.lines().nth(1).expect("PEM has lines")];
    let trace = authority.path("trace.cps.jsonl");
    let (ca, cert, key) = (authority.path("ca.pem"), authority.path("us.pem"), authority.path("us.key"));
    let run = ["run", "models/rig", "--connect", &served.url, "--ca", &ca, "--cert", &cert, "--key", &key];
    let log = [("KINETWIN_TOKEN", "opensesame"), ("KINETWIN_LOG", "trace")];
    let mut running = Running::start_with(&[&run[..], &["--record", &trace, "--json"]].concat(), &log);
    running.line("stands");
    let shown = fs::read(format!("/proc/{}/cmdline", running.id())).unwrap_or_default();
    running.interrupt();
    let ended = running.end();
    assert_eq!(ended.code(), 0, "{}", ended.stderr);
    // With a wrong one as well: an error must not repeat what it refuses.
    let plain = serve(
        ListenSettings { token: Some(Token::new("another").expect("a token")), ..ListenSettings::loopback() },
        "ws",
    );
    let arguments = ["check", "models/rig", "--connect", &plain.url];
    let wrong = Running::start_with(&arguments, &log).end();
    assert_eq!(wrong.code(), 2);
    let malformed = Running::start_with(&arguments, &[("KINETWIN_TOKEN", "opensesame opensesame")]).end();
    assert!(malformed.stderr.contains("KINETWIN_TOKEN: the token holds a character"), "{}", malformed.stderr);
    let recorded = fs::read_to_string(&trace).expect("a trace");
    assert!(recorded.contains("SendValue"), "the trace is one");
    let said = [
        shown,
        recorded.into_bytes(),
        ended.stdout.into(),
        ended.stderr.into(),
        wrong.stderr.into(),
        malformed.stderr.into(),
    ];
    for text in said {
        let text = String::from_utf8_lossy(&text);
        assert!(secrets.iter().all(|secret| !text.contains(secret)), "a secret stands in {text}");
    }
}

#[test]
fn files_that_do_not_fit_are_named() {
    let authority = Authority::new();
    authority.sign("server", "127.0.0.1");
    authority.sign("us", "kinetwin");
    authority.write("notes.txt", "nothing of the kind");
    let [ca, cert, key, server, notes, nowhere] =
        ["ca.pem", "us.pem", "us.key", "server.key", "notes.txt", "nowhere"].map(|name| authority.path(name));
    let url = Host::new().url();
    let secure = url.replace("ws://", "wss://");
    let check = |url: &str, more: &[&str], part: &str| {
        let ended = kinetwin(&[&["check", "models/rig", "--connect", url], more].concat());
        assert!(ended.stderr.contains(part), "{more:?}: {}", ended.stderr);
        assert_eq!(ended.code(), 2, "{more:?}");
    };
    check(&url, &["--ca", &ca], "--ca is for an encrypted connection: give --connect wss://HOST:PORT with it");
    check(&secure, &["--ca", &nowhere], "failed to read");
    check(&secure, &["--ca", &notes], "notes.txt holds no certificate");
    check(&secure, &["--ca", &ca, "--cert", &cert], "--key");
    check(&secure, &["--ca", &ca, "--cert", &cert, "--key", &notes], "notes.txt holds no private key");
    check(&secure, &["--ca", &ca, "--cert", &cert, "--key", &server], "is not the private key of the certificate in");
    check(&secure, &["--ca", &ca, "--cert", &cert, "--key", &key], "nobody listens there");
}
