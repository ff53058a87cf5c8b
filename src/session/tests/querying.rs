//! The query phase: asking a server for its interface, and comparing it with the plant's.

use super::*;
use crate::wire::{Interface, InterfaceSignal, Message};

fn outputs(query: &mut Query) -> Vec<String> {
    let event = |event| match event {
        QueryEvent::Dial => "dial".to_owned(),
        QueryEvent::Answered(interface) => {
            format!("answered: {} inputs, {} outputs", interface.inputs.len(), interface.outputs.len())
        }
        QueryEvent::Failed { reason } => format!("failed: {reason}"),
        QueryEvent::Notice(text) => format!("notice: {text}"),
    };
    std::iter::from_fn(|| query.poll()).map(|output| line(output, event)).collect()
}

const DONE: &str = "close 1000: the question is answered or given up";

/// A query that has asked, at t = 0.
fn asking() -> Query {
    let mut query = Query::new(Duration::from_secs(5));
    assert_eq!(outputs(&mut query), ["dial"]);
    query.handle(at(0), Input::Opened);
    assert_eq!(outputs(&mut query), [r#"→ {"QueryAll":{}}"#]);
    query
}

#[track_caller]
fn check(query: &mut Query, now: Instant, input: Input<'_>, expect: &[&str]) {
    query.handle(now, input);
    assert_eq!(outputs(query), expect);
}

fn answer() -> String {
    Message::QueryAllReply(interface_of(&map(), "mock")).encode()
}

#[test]
fn a_server_answers_query_all_without_a_connect() {
    let mut server = server();
    let reply = format!("→ {}", answer());
    for body in ["{}", "null", "[]"] {
        check_server(&mut server, at(0), Input::Text(&format!("{{\"QueryAll\":{body}}}")), &[&reply]);
    }
    assert!(!server.is_established());
    check_server(&mut serving(), at(0), Input::Text(r#"{"QueryAll":{}}"#), &[&reply]);
}

#[test]
fn a_query_asks_and_is_answered() {
    let mut query = asking();
    check(&mut query, at(1), Input::Text(&answer()), &["answered: 3 inputs, 8 outputs", DONE]);
    assert_eq!(query.timeout(), None);
    check(&mut query, at(2), Input::Closed, &[]);
}

#[test]
fn a_query_is_not_misled_by_other_messages() {
    let mut query = asking();
    let notice = "notice: a SendValue was ignored: only QueryAllReply is awaited";
    check(&mut query, at(1), Input::Text(&send_value("")), &[notice]);
    let notice = "notice: a message was ignored: malformed JSON at byte 0: expected a value, found 'h'";
    check(&mut query, at(1), Input::Text("hello"), &[notice]);
    let notice = "notice: a binary message was ignored: the protocol speaks JSON text";
    check(&mut query, at(1), Input::Binary, &[notice]);
    check(&mut query, at(1), Input::Text(&answer()), &["answered: 3 inputs, 8 outputs", DONE]);
}

#[test]
fn a_query_fails_once_and_says_why() {
    let fails =
        |now, input: Input<'_>, reason: &str| check(&mut asking(), now, input, &[&format!("failed: {reason}"), DONE]);
    fails(at(5000), Input::Timeout, "no answer to QueryAll within 5s");
    fails(at(1), Input::Closed, "the connection ended before the server answered");
    fails(at(1), Input::InvalidUtf8, "the server sent a message that is not UTF-8");
    fails(at(1), Input::TooLong { limit: 9 }, "the server sent a message longer than 9 bytes");
    fails(at(1), Input::Text(r#"{"QueryAllReply":{"result":501}}"#), "the server refused QueryAll with 501");
    fails(at(1), Input::Text(r#"{"QueryAllReply":[]}"#), "QueryAllReply expects an object, found an array, []");
    check(&mut asking(), at(4999), Input::Timeout, &[]);

    let mut query = Query::new(Duration::from_secs(5));
    outputs(&mut query);
    check(&mut query, at(0), Input::Closed, &["failed: no connection could be made", DONE]);
    let mut query = Query::new(Duration::from_secs(5));
    outputs(&mut query);
    check(&mut query, at(100), Input::Timeout, &[]);
    check(&mut query, at(5100), Input::Timeout, &["failed: no connection within 5s", DONE]);
}

#[test]
fn an_interface_that_matches_has_no_mismatch() {
    let mut interface = interface_of(&map(), "mock");
    assert_eq!(mismatches(&map(), &interface), []);
    interface.inputs.reverse();
    interface.outputs.reverse();
    assert_eq!(mismatches(&map(), &interface), [], "the order is of no account");
}

#[test]
fn mismatches_are_told_by_name_type_and_direction() {
    let mut interface = interface_of(&map(), "mock");
    let Interface { inputs, outputs, .. } = &mut interface;
    outputs.retain(|signal| signal.name != "Belt.run");
    outputs.iter_mut().filter(|s| s.name == "Belt.small").for_each(|s| s.ty = "INT".to_owned());
    outputs.iter_mut().filter(|s| s.name == "Belt.recipe").for_each(|s| s.ty = "TEXT".to_owned());
    let moved = inputs.remove(0);
    outputs.push(moved);
    let place = outputs.iter().position(|signal| signal.name == "Belt.sequence").expect("a signal");
    inputs.push(outputs.remove(place));
    inputs.push(InterfaceSignal { name: "Belt.heat".to_owned(), ty: "REAL".to_owned() });
    inputs.push(InterfaceSignal { name: "Belt.echo".to_owned(), ty: "LINT".to_owned() });
    let told: Vec<_> = mismatches(&map(), &interface).iter().map(Mismatch::to_string).collect();
    let expect = [
        "Belt.recipe: the server has type TEXT, the plant STRING",
        "Belt.small: the server has type INT, the plant SINT",
        "Belt.run: the server lacks it; expected an output of type BOOL",
        "Belt.sequence: the plant takes it as a command, and the server has it as an input, not an output",
        "Belt.velocityActual: the plant reports it, and the server has it as an output, not an input",
        "Belt.echo: the server lists it more than once",
        "Belt.heat: the server has it as an input of type REAL, the plant does not",
    ];
    assert_eq!(told, expect);
}
