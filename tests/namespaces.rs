//! R005 and R011: several simulations at one automation, each in a network namespace of its own, and a way with 40 ms of
//! delay, 10 ms of jitter and 0.5 % loss.
//!
//! It takes the right to make namespaces (root, as CI has it) and the programs `ip` and `tc`; where one is missing, the test
//! says so and is left out.

use std::io::{BufRead, BufReader};
use std::path::PathBuf;
use std::process::{Child, Command, Output, Stdio};

use serde_json::Value;
use tempfile::TempDir;

fn run(program: &str, arguments: &[&str]) -> Option<Output> {
    let output = Command::new(program).args(arguments).output().ok()?;
    output.status.success().then_some(output)
}

/// The automation's namespace, and one for each of some simulations, each joined to it by a pair of interfaces.
struct Net {
    name: String,
    simulations: usize,
}

impl Net {
    /// `None` where namespaces cannot be made; says why.
    fn new(test: &str, simulations: usize, delay: Option<&[&str]>) -> Option<Net> {
        let net = Net { name: format!("kt-{test}-{}", std::process::id()), simulations };
        let made = net.make(delay);
        if made.is_none() {
            eprintln!("left out: this machine lets us make no network namespaces, or has no ip and tc");
            // With the tools' word that all is there, a test that shows nothing must not pass.
            assert!(std::env::var_os("KINETWIN_NAMESPACES").is_none(), "namespaces were promised");
        }
        made.map(|()| net)
    }

    fn make(&self, delay: Option<&[&str]>) -> Option<()> {
        let hub = &self.name;
        run("ip", &["netns", "add", hub])?;
        for k in 0..self.simulations {
            let (space, near, far) = (self.space(k), format!("kn{k}"), format!("kf{k}"));
            run("ip", &["netns", "add", &space])?;
            run("ip", &["-n", hub, "link", "add", &near, "type", "veth", "peer", "name", &far, "netns", &space])?;
            run("ip", &["-n", hub, "addr", "add", &format!("10.199.{k}.1/24"), "dev", &near])?;
            run("ip", &["-n", &space, "addr", "add", &format!("10.199.{k}.2/24"), "dev", &far])?;
            run("ip", &["-n", hub, "link", "set", &near, "up"])?;
            run("ip", &["-n", &space, "link", "set", &far, "up"])?;
            if let Some(delay) = delay {
                let both = [(hub, &near), (&space, &far)];
                for (space, interface) in both {
                    let shape = ["netns", "exec", space, "tc", "qdisc", "add", "dev", interface, "root", "netem"];
                    run("ip", &[&shape[..], delay].concat())?;
                }
            }
        }
        Some(())
    }

    fn space(&self, k: usize) -> String {
        format!("{}-{k}", self.name)
    }

    fn spawn(&self, space: &str, program: &str, arguments: &[&str]) -> Child {
        let within = [&["netns", "exec", space, program], arguments].concat();
        let mut command = Command::new("ip");
        command.args(within).current_dir(env!("CARGO_MANIFEST_DIR")).stdin(Stdio::null());
        command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("a process in a namespace")
    }
}

impl Drop for Net {
    fn drop(&mut self) {
        for k in 0..self.simulations {
            run("ip", &["netns", "del", &self.space(k)]);
        }
        run("ip", &["netns", "del", &self.name]);
    }
}

/// The rig's automation on every address of its namespace; it ends with this.
struct Automation(Child);

impl Automation {
    fn start(net: &Net) -> Automation {
        let mock = PathBuf::from(env!("CARGO_BIN_EXE_kinetwin")).with_file_name("nxt-mock");
        assert!(mock.exists(), "tools/test builds {} first", mock.display());
        let mut child =
            net.spawn(&net.name, mock.to_str().expect("UTF-8"), &["--plant", "rig", "--listen", "0.0.0.0:4711"]);
        let mut line = String::new();
        BufReader::new(child.stdout.as_mut().expect("a pipe")).read_line(&mut line).expect("a line");
        assert!(line.contains("controls"), "{line}");
        Automation(child)
    }

    /// Ends it as Ctrl-C does; its last words.
    fn stop(mut self) -> String {
        run("sh", &["-c", &format!("kill -INT {}", self.0.id())]).expect("it runs");
        let mut said = String::new();
        std::io::Read::read_to_string(&mut self.0.stdout.take().expect("a pipe"), &mut said).expect("text");
        said
    }
}

impl Drop for Automation {
    fn drop(&mut self) {
        // It has ended already, unless the test fails.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn simulate(net: &Net, k: usize, span: &str, trace: &str) -> Child {
    let url = format!("ws://10.199.{k}.1:4711");
    let arguments = ["run", "models/rig", "--connect", &url, "--for", span, "--record", trace, "--json"];
    net.spawn(&net.space(k), env!("CARGO_BIN_EXE_kinetwin"), &arguments)
}

fn summary(child: Child) -> Value {
    let ended = child.wait_with_output().expect("an end");
    assert!(ended.status.success(), "{}", String::from_utf8_lossy(&ended.stderr));
    serde_json::from_slice(&ended.stdout).expect("a summary")
}

/// The automation's messages in a trace, after the first, which holds the present values.
fn commands(trace: &str) -> Vec<String> {
    let text = std::fs::read_to_string(trace).expect("a trace");
    let lines = text.lines().filter(|line| line.contains(r#""from":"automation","SendValue""#)).skip(1);
    lines.map(|line| line.split_once(r#""SendValue":"#).expect("values").1.to_owned()).collect()
}

#[test]
fn simulations_in_different_networks_receive_the_same_sequence() {
    let Some(net) = Net::new("many", 3, None) else { return };
    let folder = TempDir::new().expect("a folder");
    let automation = Automation::start(&net);
    let traces: Vec<String> =
        (0..3).map(|k| folder.path().join(format!("{k}.cps.jsonl")).display().to_string()).collect();
    let running: Vec<Child> = (0..3).map(|k| simulate(&net, k, "4s", &traces[k])).collect();
    for child in running {
        let summary = summary(child);
        assert_eq!((&summary["sessions"], &summary["messages_lost"]), (&1.into(), &0.into()), "{summary}");
    }
    let said = automation.stop();
    assert!(said.contains("sessions    3"), "{said}");
    let heard: Vec<Vec<String>> = traces.iter().map(|trace| commands(trace)).collect();
    let shortest = heard.iter().map(Vec::len).min().expect("three");
    assert!(shortest > 10, "{heard:?}");
    // They came and went at times of their own: what they have in common is all that came between.
    for commands in &heard[1..] {
        assert!(2 * overlap(&heard[0], commands) >= shortest, "{commands:?}\n{:?}", heard[0]);
    }
}

/// The longest that two sequences have in common where one is laid over the other and they agree from end to end.
fn overlap(one: &[String], other: &[String]) -> usize {
    let laid = |one: &[String], other: &[String]| {
        let agrees = |from: &usize| one[*from..].iter().zip(other).all(|(one, other)| one == other);
        (0..one.len()).find(agrees).map_or(0, |from| (one.len() - from).min(other.len()))
    };
    laid(one, other).max(laid(other, one))
}

#[test]
fn through_a_slow_way_that_loses_packets_nothing_is_lost_and_the_latency_is_said() {
    let Some(net) = Net::new("slow", 1, Some(&["delay", "40ms", "10ms", "loss", "0.5%"])) else { return };
    let folder = TempDir::new().expect("a folder");
    let automation = Automation::start(&net);
    let trace = folder.path().join("slow.cps.jsonl").display().to_string();
    let summary = summary(simulate(&net, 0, "8s", &trace));
    assert_eq!((&summary["sessions"], &summary["messages_lost"]), (&1.into(), &0.into()), "{summary}");
    let said = automation.stop();
    // What the one counted out, the other counted in.
    let counted = format!("{} in, {} out", summary["messages_out"], summary["messages_in"]);
    assert!(said.contains(&counted), "{counted} and {said}");
    let p50 = said.split_once("p50 ").and_then(|(_, rest)| rest.split_once(" us")).expect(&said).0;
    let p50: u64 = p50.parse().expect("a number");
    assert!(p50 > 60_000, "40 ms each way, and {p50} us there and back");
}
