//! The one pass over a message that is spelt as ours are is no other reader: what it takes, the general one takes as well,
//! and makes the same of it.

use proptest::prelude::*;

use super::super::exchange::Exchange;
use super::*;
use crate::value::Value;
use crate::wire::{Message, SendValueText};

/// What the general reader makes of `text`, where it finds no fault.
fn by_the_general_way(text: &str) -> Option<Staged> {
    let Ok(Message::SendValue(entries)) = Message::decode(text) else { return None };
    let receipt = Exchange::new(map(), Direction::Report).receive(text, &entries);
    receipt.outcome.ok().filter(|staged| staged.faults.is_empty())
}

fn values() -> impl Strategy<Value = Vec<(&'static str, Value)>> {
    let value = |name: &'static str, value: BoxedStrategy<Value>| value.prop_map(move |value| (name, value)).boxed();
    let one = prop_oneof![
        value("Belt.velocityTarget", (-0.1f32..=0.1).prop_map(Value::Real).boxed()),
        value("Belt.motorDirection", (-1i32..=1).prop_map(Value::Dint).boxed()),
        value("Belt.recipe", prop::collection::vec(any::<u8>(), 0..9).prop_map(|v| Value::String(v.into())).boxed()),
        value(
            "Belt.matrix",
            prop::array::uniform3(0.0..9.0).prop_map(|v| Value::Array(v.map(Value::Lreal).into())).boxed()
        ),
        value("Belt.run", any::<bool>().prop_map(Value::Bool).boxed()),
        value("Belt.sequence", any::<i64>().prop_map(Value::Lint).boxed()),
        value("Belt.delay", (0i64..2_000_000_000).prop_map(Value::Time).boxed()),
    ];
    prop::collection::vec(one, 1..8)
}

fn written(values: &[(&str, Value)]) -> String {
    let mut text = SendValueText::with_capacity(values.len());
    values.iter().for_each(|(name, value)| text.push(name, value).expect("a value with a JSON form"));
    text.finish().expect("at least one value")
}

/// `text` with a piece of it gone, another put in, or a blank in the way.
fn spoilt() -> impl Strategy<Value = String> {
    let piece = prop::sample::select(vec![
        "",
        " ",
        "\n",
        ",",
        "}",
        "]",
        "{",
        "\"",
        "\\",
        "\\u0042",
        "true",
        "9e9",
        "-",
        "0",
        "[1]",
        "[[1]]",
        "null",
        "é",
        "\"name\":",
        "Belt.echo",
        "Belt.none",
        "]}",
    ]);
    (values(), any::<prop::sample::Index>(), 0usize..12, piece).prop_map(|(values, at, gone, piece)| {
        let text = written(&values);
        let from = at.index(text.len() + 1);
        // What we write is ASCII.
        format!("{}{piece}{}", &text[..from], &text[(from + gone).min(text.len())..])
    })
}

proptest! {
    #[test]
    fn what_we_write_is_read_in_one_pass_as_the_general_way_reads_it(messages in prop::collection::vec(values(), 1..4)) {
        let mut exchange = Exchange::new(map(), Direction::Report);
        for values in messages {
            let text = written(&values);
            let mut names: Vec<_> = values.iter().map(|(name, _)| name).collect();
            names.sort();
            let twice = names.windows(2).any(|pair| pair[0] == pair[1]);
            let staged = exchange.receive_plain(&text, 100);
            prop_assert_eq!(staged, by_the_general_way(&text).filter(|_| !twice), "{}", text);
        }
    }

    #[test]
    fn what_is_spelt_otherwise_is_read_alike_or_left_to_the_general_way(text in spoilt()) {
        let staged = Exchange::new(map(), Direction::Report).receive_plain(&text, 100);
        if staged.is_some() {
            prop_assert_eq!(staged, by_the_general_way(&text), "{}", text);
        }
    }
}

#[test]
fn a_message_of_more_values_than_the_limit_is_left_to_the_general_way() {
    let text = written(&[("Belt.run", Value::Bool(true)), ("Belt.small", Value::Sint(1))]);
    let mut exchange = Exchange::new(map(), Direction::Report);
    assert!(exchange.receive_plain(&text, 1).is_none());
    assert_eq!(exchange.receive_plain(&text, 2), by_the_general_way(&text));
}
