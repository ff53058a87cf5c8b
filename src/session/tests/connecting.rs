//! The rules under "Connecting".

use super::*;
use crate::value::Value;
use crate::wire::ResultCode;

const CONNECT: &str = r#"→ {"Connect":{"Id":"cnVuIDE=","enable":true}}"#;
const DISCONNECT: &str = r#"→ {"Connect":{"Id":"cnVuIDE=","enable":false}}"#;

#[test]
fn the_client_speaks_first() {
    let mut client = client();
    assert_eq!(client_outputs(&mut client), ["dial 1"]);
    check_client(&mut client, at(3), Input::Opened, &[CONNECT]);
    check_client(&mut client, at(4), Input::Text(&reply(true, 200)), &["established with mock"]);
    assert_eq!(client.timeout(), None);
}

#[test]
fn connection_reply_is_accepted_too() {
    let mut client = connecting();
    let text = reply(true, 200).replace("ConnectReply", "ConnectionReply");
    check_client(&mut client, at(0), Input::Text(&text), &["established with mock"]);
}

#[test]
fn the_server_answers_connect_with_connect_reply() {
    let mut server = server();
    let reply = r#"→ {"ConnectReply":{"Id":"cnVuIDE=","enable":true,"ServerName":"bW9jaw==","result":200}}"#;
    check_server(&mut server, at(0), Input::Text(&connect("run 1", true)), &[reply, "connected run 1"]);
}

#[test]
fn a_4xx_is_retried_on_the_same_connection_after_growing_pauses() {
    let mut client = connecting();
    let mut now = at(0);
    for (result, retry) in [(404, "0.500 s"), (429, "1.500 s"), (400, "3.500 s"), (499, "7.500 s")] {
        let refused = format!("refused {result}  retry {retry}");
        check_client(&mut client, now, Input::Text(&reply(true, result)), &[&refused]);
        let early = client.timeout().expect("a retry") - Duration::from_nanos(1);
        check_client(&mut client, early, Input::Timeout, &[]);
        now = client.timeout().expect("a retry");
        check_client(&mut client, now, Input::Timeout, &[CONNECT]);
    }
    check_client(&mut client, now, Input::Text(&reply(true, 200)), &["established with mock"]);
}

#[test]
fn no_answer_within_the_timeout_is_retried_on_a_new_connection() {
    let mut client = connecting();
    assert_eq!(client.timeout(), Some(at(5000)));
    check_client(&mut client, at(4999), Input::Timeout, &[]);
    let reason = "no valid answer to Connect within 5s";
    let lost = format!("no session: {reason}, retry 5.500 s");
    check_client(&mut client, at(5000), Input::Timeout, &[&format!("close 1008: {reason}"), &lost]);
    check_client(&mut client, at(5500), Input::Timeout, &["dial 2"]);
    check_client(&mut client, at(5501), Input::Opened, &[CONNECT]);
}

#[test]
fn pauses_grow_to_a_cap() {
    let mut client = client();
    client_outputs(&mut client);
    let mut now = at(0);
    let mut pauses = Vec::new();
    for attempt in 2..=12 {
        client.handle(now, Input::Closed);
        let retry = client.timeout().expect("a retry");
        pauses.push(retry.since(now).as_millis());
        now = retry;
        client.handle(now, Input::Timeout);
        let outputs = client_outputs(&mut client);
        assert_eq!(outputs.last(), Some(&format!("dial {attempt}")));
    }
    assert_eq!(pauses, [500, 1000, 2000, 4000, 8000, 16_000, 30_000, 30_000, 30_000, 30_000, 30_000]);
}

#[test]
fn pauses_begin_anew_once_a_session_stood() {
    let mut client = connecting();
    for ms in [0, 500, 1500] {
        client.handle(at(ms), Input::Text(&reply(true, 404)));
        let retry = client.timeout().expect("a retry");
        client.handle(retry, Input::Timeout);
    }
    client.handle(at(3500), Input::Text(&reply(true, 200)));
    client_outputs(&mut client);
    check_client(&mut client, at(4000), Input::Closed, &["session lost: the connection ended, retry 4.500 s"]);
    check_client(&mut client, at(4500), Input::Timeout, &["dial 1"]);
}

#[test]
fn a_5xx_is_final() {
    let mut client = connecting();
    let text = reply(true, 503).replace("503", r#"503,"message":"out of order""#);
    let expect = [
        "close 1000: refused with 503",
        "refused 503 out of order retry never",
        r#"ended: Refused { result: ResultCode(503), message: Some("out of order") }"#,
    ];
    check_client(&mut client, at(0), Input::Text(&text), &expect);
    assert_eq!(client.timeout(), None);
    for input in [Input::Closed, Input::Timeout, Input::Text(&reply(true, 200))] {
        check_client(&mut client, at(90_000), input, &[]);
    }
}

#[test]
fn any_other_result_is_logged_and_the_session_stays_closed() {
    for result in [0, -1, 100, 201, 302, 600, 20_000] {
        let mut client = connecting();
        let notice = format!("notice: a ConnectReply was ignored: its result {result} is neither 200 nor 4xx nor 5xx");
        check_client(&mut client, at(0), Input::Text(&reply(true, result)), &[&notice]);
        assert!(!client.is_established() && client.timeout() == Some(at(5000)));
    }
}

#[test]
fn a_foreign_id_is_logged_and_the_session_stays_closed() {
    let mut client = connecting();
    let notice = "notice: a ConnectReply was ignored: its Id is \"run 2\", not ours";
    check_client(&mut client, at(0), Input::Text(&reply_to("run 2", true, 200)), &[notice]);
    check_client(&mut client, at(0), Input::Text(&reply_to("run 2", true, 500)), &[notice]);
    // The right answer may still come.
    check_client(&mut client, at(1), Input::Text(&reply(true, 200)), &["established with mock"]);
}

#[test]
fn a_wrong_enable_is_logged_and_the_session_stays_closed() {
    let mut client = connecting();
    let notice = "notice: a ConnectReply was ignored: it says enable false, and Connect said true";
    check_client(&mut client, at(0), Input::Text(&reply(false, 200)), &[notice]);
    assert!(!client.is_established());
}

#[test]
fn a_reply_that_nobody_asked_for_changes_nothing() {
    let mut client = established();
    for result in [200, 404, 500] {
        let notice = "notice: a ConnectReply was ignored: nothing was asked";
        check_client(&mut client, at(0), Input::Text(&reply(true, result)), &[notice]);
        assert!(client.is_established());
    }
}

#[test]
fn the_id_is_the_same_for_all_connections() {
    let mut client = established();
    client.handle(at(0), Input::Closed);
    client.handle(at(500), Input::Timeout);
    client_outputs(&mut client);
    check_client(&mut client, at(500), Input::Opened, &[CONNECT]);
}

#[test]
fn no_send_value_goes_out_before_a_200() {
    let values = [(register("Belt.lightBarrierA"), Value::Bool(true))];
    let mut client = client();
    assert!(!client.send(at(0), &values));
    client.handle(at(0), Input::Opened);
    assert!(!client.send(at(0), &values));
    client.handle(at(0), Input::Text(&reply(true, 404)));
    assert!(!client.send(at(0), &values));
    client.handle(at(500), Input::Timeout);
    client.handle(at(500), Input::Text(&reply(true, 200)));
    client_outputs(&mut client);
    assert!(client.send(at(500), &values));
    assert_eq!(client_outputs(&mut client), [r#"→ {"SendValue":[{"name":"Belt.lightBarrierA","value":true}]}"#]);

    let mut server = server();
    let values = [(register("Belt.run"), Value::Bool(true))];
    assert!(!server.send(at(0), &values));
    assert_eq!(server_outputs(&mut server), Vec::<String>::new());
}

#[test]
fn values_that_come_before_the_200_are_refused() {
    let mut client = connecting();
    let text = send_value(r#"{"name":"Belt.run","value":true}"#);
    let rejected = format!("rejected {text}: values came before the server accepted the session");
    check_client(&mut client, at(0), Input::Text(&text), &[&rejected]);

    let mut server = server();
    let text = send_value(r#"{"name":"Belt.echo","value":1}"#);
    let rejected = format!("rejected {text}: values came before a Connect was accepted");
    check_server(&mut server, at(0), Input::Text(&text), &[&rejected]);
}

#[test]
fn every_200_asks_for_the_present_outputs() {
    let mut client = established();
    client.handle(at(0), Input::Closed);
    client.handle(at(500), Input::Timeout);
    client.handle(at(500), Input::Opened);
    client_outputs(&mut client);
    check_client(&mut client, at(500), Input::Text(&reply(true, 200)), &["established with mock"]);

    // At the server, too: a client that says Connect again has lost what it knew.
    let mut server = serving();
    server.handle(at(0), Input::Text(&connect("run 1", true)));
    assert_eq!(server_outputs(&mut server).last().map(String::as_str), Some("connected run 1"));
}

#[test]
fn an_absent_server_is_retried_until_the_run_ends() {
    let mut client = client();
    client_outputs(&mut client);
    check_client(&mut client, at(0), Input::Closed, &["no session: no connection could be made, retry 0.500 s"]);
    check_client(&mut client, at(500), Input::Timeout, &["dial 2"]);
    client.disconnect(at(600));
    let over = ["close 1000: the run is over", "ended: Disconnected"];
    assert_eq!(client_outputs(&mut client), over);
    assert_eq!(client.timeout(), None);
}

#[test]
fn a_dial_that_hangs_is_given_up_after_the_timeout() {
    let mut client = client();
    client_outputs(&mut client);
    // The client learns what time it is, and then waits from there.
    assert!(client.timeout() < Some(at(0)));
    check_client(&mut client, at(7000), Input::Timeout, &[]);
    assert_eq!(client.timeout(), Some(at(12_000)));
    let expect = ["close 1000: no connection within 5s", "no session: no connection within 5s, retry 12.500 s"];
    check_client(&mut client, at(12_000), Input::Timeout, &expect);
    // It opens after all, too late.
    check_client(&mut client, at(12_001), Input::Opened, &["close 1000: no longer wanted"]);
    check_client(&mut client, at(12_500), Input::Timeout, &["dial 2"]);
    assert_eq!(client.timeout(), Some(at(17_500)));
}

#[test]
fn a_connection_that_ends_while_waiting_to_ask_again_is_made_anew() {
    let mut client = connecting();
    client.handle(at(0), Input::Text(&reply(true, 404)));
    client_outputs(&mut client);
    let notice = "notice: the connection ended while waiting to ask again";
    check_client(&mut client, at(100), Input::Closed, &[notice]);
    check_client(&mut client, at(500), Input::Timeout, &["dial 2"]);
}

#[test]
fn a_connection_that_ends_before_the_answer_is_made_anew() {
    let mut client = connecting();
    let lost = "no session: the connection ended before the server answered, retry 0.501 s";
    check_client(&mut client, at(1), Input::Closed, &[lost]);
    // What the old connection's transport still says is of no account.
    check_client(&mut client, at(2), Input::Closed, &[]);
    check_client(&mut client, at(2), Input::Text(&reply(true, 200)), &[]);
}

#[test]
fn disconnect_waits_for_the_answer_and_closes() {
    let mut client = established();
    client.disconnect(at(0));
    assert_eq!(client_outputs(&mut client), [DISCONNECT]);
    // What the server said before it heard of it still counts.
    let text = send_value(r#"{"name":"Belt.run","value":true}"#);
    check_client(&mut client, at(1), Input::Text(&text), &["values Belt.run=true"]);
    assert!(!client.send(at(1), &[(register("Belt.echo"), Value::Lint(1))]));
    let over = ["close 1000: the run is over", "ended: Disconnected"];
    check_client(&mut client, at(2), Input::Text(&reply(false, 200)), &over);
    client.disconnect(at(3));
    assert_eq!(client_outputs(&mut client), Vec::<String>::new());
}

#[test]
fn disconnect_waits_at_most_the_timeout() {
    let mut client = established();
    client.disconnect(at(1000));
    client_outputs(&mut client);
    assert_eq!(client.timeout(), Some(at(6000)));
    let over = ["close 1000: the run is over", "ended: Unanswered"];
    check_client(&mut client, at(6000), Input::Timeout, &over);

    let mut client = established();
    client.disconnect(at(1000));
    client_outputs(&mut client);
    check_client(&mut client, at(1001), Input::Closed, &["ended: Unanswered"]);
}

#[test]
fn disconnect_that_overtakes_the_answer_to_connect() {
    let mut client = connecting();
    client.disconnect(at(1));
    assert_eq!(client_outputs(&mut client), [DISCONNECT]);
    check_client(&mut client, at(2), Input::Text(&reply(true, 200)), &[]);
    let over = ["close 1000: the run is over", "ended: Disconnected"];
    check_client(&mut client, at(3), Input::Text(&reply(false, 200)), &over);
}

#[test]
fn an_error_on_disconnection_is_logged_and_ends_all_the_same() {
    let mut client = established();
    client.disconnect(at(1));
    client_outputs(&mut client);
    let text = reply(false, 404).replace("404", r#"404,"message":"who?""#);
    let expect = [
        "notice: the server answered the disconnection with 404: who?",
        "close 1000: the run is over",
        "ended: Disconnected",
    ];
    check_client(&mut client, at(2), Input::Text(&text), &expect);
}

#[test]
fn disconnect_by_an_unknown_id_gets_404_with_a_message() {
    let check = |mut server: Server, id: &str| {
        server.handle(at(0), Input::Text(&connect(id, false)));
        let outputs = server_outputs(&mut server);
        let message = format!("no session of \\\"{id}\\\" stands on this connection");
        let reply = format!(r#""enable":false,"ServerName":"bW9jaw==","result":404,"message":"{message}"}}}}"#);
        assert!(outputs[1].ends_with(&reply), "{outputs:?}");
    };
    check(server(), "run 1");
    check(serving(), "run 2");
    let mut server = serving();
    server.handle(at(0), Input::Text(&connect("run 2", false)));
    assert!(server.is_established(), "another's disconnection must not end this session");
}

#[test]
fn the_server_ends_a_session_and_takes_another_on_the_same_connection() {
    let mut server = serving();
    let reply = r#"→ {"ConnectReply":{"Id":"cnVuIDE=","enable":false,"ServerName":"bW9jaw==","result":200}}"#;
    check_server(&mut server, at(0), Input::Text(&connect("run 1", false)), &[reply, "disconnected"]);
    assert!(!server.is_established());
    server.handle(at(0), Input::Text(&connect("run 2", true)));
    assert!(server.is_established());
}

#[test]
fn a_connection_serves_one_session_at_a_time() {
    let mut server = serving();
    server.handle(at(0), Input::Text(&connect("run 2", true)));
    let outputs = server_outputs(&mut server);
    assert!(outputs[0].contains(r#""result":409,"message":"this connection belongs to the session of \"run 1\"""#));
    assert_eq!(outputs[1], "refused run 2 with 409");
    assert!(server.is_established());
}

#[test]
fn a_server_may_refuse() {
    let mut settings = ServerSettings::new("mock");
    settings.refuse = Some((ResultCode(503), "out of order".to_owned()));
    let mut server = Server::new(settings, map());
    let reply = r#"→ {"ConnectReply":{"Id":"cnVuIDE=","enable":true,"ServerName":"bW9jaw==","result":503,"message":"out of order"}}"#;
    check_server(&mut server, at(0), Input::Text(&connect("run 1", true)), &[reply, "refused run 1 with 503"]);
    assert!(!server.is_established());
}

#[test]
fn the_end_of_a_connection_is_said_once() {
    let mut server = serving();
    check_server(&mut server, at(0), Input::Closed, &["session lost: the connection ended"]);
    check_server(&mut server, at(0), Input::Closed, &[]);
    check_server(&mut server, at(0), Input::Text(&connect("run 1", true)), &[]);

    let mut server = serving();
    server.close(1001, "going away");
    server.close(1001, "going away");
    assert_eq!(server_outputs(&mut server), ["close 1001: going away", "session lost: going away"]);
}
