//! The page about effects, as the registry gives it.

use std::fmt::Write;

use super::{EFFECTS, EffectDescriptor, EffectParameter, Fit, Needs, SignalClass};
use crate::plant::EffectPlace;
use crate::prototype::quantity::si_unit;
use crate::value::Quantity;

const HEAD: &str = "# Effects

What a real device adds to the nominal law of its kind. An effect stands on an instance in a plant's file, at its place in the
signal path:

    <effect place=\"transmission\" kind=\"belt-slip\">
      <parameter name=\"ratio\" value=\"0.06\"/>
    </effect>

    command link → actuator → mechanics → transmission → load → sensor → report link      (and the process: the parts)

`component` names the axis or the signal that it acts on, where the device has several; without it, an effect of a link acts on
every signal that goes that way, and one of a sensor on the position, where there is one. Numbers are in SI units unless they
name another: `value=\"5 ms\"`. At its nominal parameters an effect does nothing: the device computes its nominal law, bit by bit.

Written from the registry: `KINETWIN_BLESS=1 cargo test --test effects`.
";

/// The page, as Markdown.
pub fn page() -> String {
    let mut page = HEAD.to_owned();
    let _ = writeln!(page, "\n| effect | stands at | in one sentence |\n| --- | --- | --- |");
    for effect in EFFECTS {
        let places = places(effect);
        let _ = writeln!(page, "| [`{id}`](#{id}) | {places} | {} |", effect.summary, id = effect.id);
    }
    for effect in EFFECTS {
        describe(effect, &mut page);
    }
    page
}

fn describe(effect: &EffectDescriptor, page: &mut String) {
    let _ = writeln!(page, "\n## {}\n\n{}.\n", effect.id, capital(effect.summary));
    let _ = writeln!(page, "    {}\n", effect.equation);
    let fits: Vec<String> = effect.fits.iter().map(of).collect();
    let _ = writeln!(page, "- Stands at: {}", places(effect));
    let _ = writeln!(page, "- Acts on: {}{}", fits.join("; "), needs(effect.needs));
    let _ = writeln!(page, "- Seen by: {}", effect.excited_by);
    let _ = writeln!(page, "- Source: {}", effect.source);
    if !effect.parameters.is_empty() {
        let head = "| parameter | unit | from | to | does nothing at | typical | if not given | what it is |";
        let _ = writeln!(page, "\n{head}\n| --- | --- | --- | --- | --- | --- | --- | --- |");
    }
    for parameter in effect.parameters {
        let EffectParameter { name, range: (least, greatest), nominal, typical, default, summary, .. } = parameter;
        let nothing = if effect.acts_always { "–".to_owned() } else { number(*nominal) };
        let default = default.map_or("must be given".to_owned(), number);
        let (unit, least, greatest) = (units(parameter.quantities), number(*least), number(*greatest));
        let typical = number(*typical);
        let _ = writeln!(
            page,
            "| `{name}` | {unit} | {least} | {greatest} | {nothing} | {typical} | {default} | {summary} |"
        );
    }
    for text in effect.texts {
        let must = if text.required { "must be given" } else { "may be given" };
        let _ = writeln!(page, "\nThe property `{}`, a text, {must}: {}.", text.name, text.summary);
    }
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

fn places(effect: &EffectDescriptor) -> String {
    if effect.places.len() == EffectPlace::ALL.len() {
        return "any place".to_owned();
    }
    effect.places.iter().map(|place| place.name()).collect::<Vec<_>>().join(", ")
}

fn of(fit: &Fit) -> String {
    match fit {
        Fit::Signals(SignalClass::Any) => "any signal".to_owned(),
        Fit::Signals(SignalClass::Boolean) => "signals that are BOOL".to_owned(),
        Fit::Signals(SignalClass::Number) => "signals that are numbers".to_owned(),
        Fit::Signals(SignalClass::Motion) => "signals that are numbers, and switches along a way".to_owned(),
        Fit::Drives(kinds) | Fit::Parts(kinds) => kinds.join(", "),
    }
}

fn needs(needs: Needs) -> &'static str {
    match needs {
        Needs::Nothing => "",
        Needs::Dynamics => "; a ServoAxis not in mode ideal",
        Needs::Speed => "; a ServoAxis in mode ideal, or one that is asked for a speed",
    }
}

/// The symbols of what it may count in, linear first.
fn units(quantities: &[Quantity]) -> String {
    let symbols: Vec<&str> = quantities.iter().map(|quantity| si_unit(*quantity).symbol).collect();
    match symbols.join(", ") {
        none if none.is_empty() => "1".to_owned(),
        symbols => symbols,
    }
}

fn number(number: f64) -> String {
    match number.abs() {
        0.0 => "0".to_owned(),
        size if !(1e-3..1e6).contains(&size) => format!("{number:e}"),
        _ => number.to_string(),
    }
}
