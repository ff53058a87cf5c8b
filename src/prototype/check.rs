//! A prototype against itself and against the device kinds: what it names has to be there, and to fit.

use super::avatar::{Condition, Map, Property, SignalDeclaration, TaskDeclaration};
use super::kind::{KindDescriptor, ParameterType, PortDescriptor, PortType};
use super::meta::{Logics, MetaDescriptor};
use super::setting::Setting;
use super::substitute::substitute;
use super::{Assignment, Task};
use crate::signal_map::Direction;
use crate::value::{ElementaryType, SignalType};
use crate::xml::{Faults, Located, nearest, one_of};

/// The task that a meta-descriptor's logics become.
const LOGICS: &str = "logics";

/// References to parameters that are not there, and properties that hide a parameter of their name.
pub(super) fn settings(meta: &MetaDescriptor, properties: &[Property], tasks: &[TaskDeclaration], faults: &mut Faults) {
    for Property { setting, .. } in properties {
        let hidden = meta.parameters.iter().find(|parameter| parameter.setting.name.value == setting.name.value);
        if let Some(parameter) = hidden
            && setting.default.value != format!("${{{}}}", setting.name.value)
        {
            let found = format!("a parameter and a property are called {:?}", setting.name.value);
            let expected =
                format!("expected \"${{{}}}\": the property takes the parameter's value", setting.name.value);
            faults.push(setting.default.fault(found, expected).beside(&parameter.setting.name.place, "the parameter"));
        }
    }
    let of_properties = properties.iter().map(|property| &property.setting.default);
    let of_tasks = tasks.iter().flat_map(|task| &task.properties).map(|setting| &setting.default);
    let of_logics = meta.logics.iter().flat_map(|logics| &logics.params).map(|param| &param.content);
    for text in of_properties.chain(of_tasks).chain(of_logics) {
        let known: Vec<&str> = meta.parameters.iter().map(|p| p.setting.name.value.as_str()).collect();
        let find = |name: &str| known.contains(&name).then_some("");
        if let Err(name) = substitute(&text.value, "", find) {
            let expected = match known.as_slice() {
                [] => "expected a parameter of prototype.xml, which has none".to_owned(),
                known => format!("expected a parameter of prototype.xml: {}", one_of(known)),
            };
            let found = format!("{:?} refers to a parameter {name:?}, which is not there", text.value);
            let fault = text.fault(found, expected);
            faults.push(fault.did_you_mean(nearest(&name, known)));
        }
    }
}

/// The tasks with their kinds and with what sets their parameters.
pub(super) fn tasks(
    meta: &MetaDescriptor,
    properties: &[Property],
    declared: Vec<TaskDeclaration>,
    kinds: &[&'static KindDescriptor],
    faults: &mut Faults,
) -> Option<Vec<Task>> {
    let logics = meta.logics.as_ref().map(task_of_logics);
    if let (Some(logics), Some(task)) = (&meta.logics, declared.first()) {
        let fault = logics.ty.fault("a law as logics, and tasks", "expected either, not both");
        faults.push(fault.beside(&task.name.place, "the avatar's first task"));
        return None;
    }
    let mut tasks = Vec::new();
    let mut strangers = false;
    for task in declared.into_iter().chain(logics) {
        let Some(kind) = kinds.iter().find(|kind| kind.name == task.ty.value) else {
            let names: Vec<&str> = kinds.iter().map(|kind| kind.name).collect();
            let found = format!("there is no device kind {:?}", task.ty.value);
            let fault = task.ty.fault(found, format!("expected {}", one_of(&names)));
            // What all of them begin with makes none of them near.
            let last = |name: &'static str| name.rsplit('.').next().unwrap_or(name);
            let near =
                nearest(task.ty.value.rsplit('.').next().unwrap_or_default(), kinds.iter().map(|kind| last(kind.name)));
            let near = near.and_then(|near| kinds.iter().find(|kind| last(kind.name) == near));
            faults.push(fault.did_you_mean(near.map(|kind| kind.name)));
            strangers = true;
            continue;
        };
        let assignments = task.properties.into_iter().filter_map(|setting| own(kind, setting, faults)).collect();
        tasks.push(Task { name: task.name, kind, assignments });
    }
    // Without its kind a task's maps cannot be judged, and would be told as wrong for no fault of their own.
    if strangers {
        return None;
    }
    for (index, property) in properties.iter().enumerate() {
        for map in &property.maps {
            assign(&mut tasks, index, &property.setting, map, faults);
        }
    }
    Some(tasks)
}

fn task_of_logics(logics: &Logics) -> TaskDeclaration {
    let setting = |param: &super::meta::Param| Setting {
        name: param.name.clone(),
        ty: param.ty,
        default: param.content.clone(),
        unit: None,
        tolerance: None,
        constraints: Vec::new(),
    };
    TaskDeclaration {
        name: Located::new(LOGICS.to_owned(), &logics.ty.place),
        ty: logics.ty.clone(),
        properties: logics.params.iter().map(setting).collect(),
    }
}

/// A task's own property as an assignment.
fn own(kind: &'static KindDescriptor, setting: Setting, faults: &mut Faults) -> Option<(usize, Assignment)> {
    let index = parameter(kind, &setting.name, faults)?;
    fits(kind, index, &setting, &setting.name, faults);
    Some((index, Assignment::Own(setting)))
}

/// What a `<map>` of a property assigns.
fn assign(tasks: &mut [Task], property: usize, setting: &Setting, map: &Map, faults: &mut Faults) {
    let Some(task) = task(tasks, map, faults) else { return };
    let task = &mut tasks[task];
    let Some(index) = parameter(task.kind, &map.property, faults) else { return };
    fits(task.kind, index, setting, &map.property, faults);
    if task.assignments.iter().any(|(known, _)| *known == index) {
        let found = format!("{:?} of the task {:?} is set twice", map.property.value, task.name.value);
        faults.push(map.property.fault(found, "expected one property that sets it"));
        return;
    }
    task.assignments.push((index, Assignment::Property(property)));
}

fn task(tasks: &[Task], map: &Map, faults: &mut Faults) -> Option<usize> {
    let index = tasks.iter().position(|task| task.name.value == map.task.value);
    if index.is_none() {
        let names: Vec<&str> = tasks.iter().map(|task| task.name.value.as_str()).collect();
        let found = format!("a map to a task {:?}, which is not there", map.task.value);
        let fault = map.task.fault(found, format!("expected a task of this prototype: {}", one_of(&names)));
        faults.push(fault.did_you_mean(nearest(&map.task.value, names)));
    }
    index
}

fn parameter(kind: &'static KindDescriptor, name: &Located<String>, faults: &mut Faults) -> Option<usize> {
    let index = kind.parameters.iter().position(|parameter| parameter.name == name.value);
    if index.is_none() {
        let names = kind.parameters.iter().map(|parameter| parameter.name);
        let found = match kind.port(&name.value) {
            Some(_) => format!("{:?} of {} is a signal's, not a property's", name.value, kind.name),
            None => format!("{} has no parameter {:?}", kind.name, name.value),
        };
        let fault = name.fault(found, format!("expected {}", one_of(names.clone())));
        faults.push(fault.did_you_mean(nearest(&name.value, names)));
    }
    index
}

fn fits(kind: &KindDescriptor, index: usize, setting: &Setting, at: &Located<String>, faults: &mut Faults) {
    let parameter = &kind.parameters[index];
    if !setting.ty.fits(&parameter.ty) {
        let found = format!("{:?} is declared as {}", setting.name.value, setting.ty);
        let expected = format!("expected {}, as {} of {} is", fitting(&parameter.ty), parameter.name, kind.name);
        faults.push(at.fault(found, expected));
    }
    if let Some(unit) = setting.unit
        && !parameter.quantities.contains(&unit.quantity)
    {
        let symbols = super::quantity::symbols(parameter.quantities);
        let found = format!("{:?} is declared in {unit}", setting.name.value);
        faults.push(at.fault(found, format!("expected {}", one_of(symbols))));
    }
}

/// The basic data types that fit a parameter.
fn fitting(parameter: &ParameterType) -> &'static str {
    match parameter {
        ParameterType::Number { .. } => "double, float or integer",
        ParameterType::Integer { .. } => "integer",
        ParameterType::Boolean => "boolean",
        ParameterType::Choice(_) | ParameterType::Instance => "string",
        ParameterType::Text => "string or URI",
        ParameterType::Numbers { .. } => "double[], float[], integer[] or vector3",
    }
}

/// Faults for properties that nothing takes.
pub(super) fn properties_are_used(signals: &[SignalDeclaration], properties: &[Property], faults: &mut Faults) {
    for Property { setting, maps } in properties {
        let name = &setting.name;
        let asked = |signal: &SignalDeclaration| signal.when.as_ref().is_some_and(|when| when.property == name.value);
        if maps.is_empty() && !signals.iter().any(asked) {
            let found = format!("the property {:?} sets nothing", name.value);
            let fault = name.fault(found, "expected a <map task=\"…\" property=\"…\"/> in it");
            faults.push(fault.help("map it to what it should set, or remove it"));
        }
    }
}

/// Faults of a signal's condition.
pub(super) fn condition(
    signal: &SignalDeclaration,
    meta: &MetaDescriptor,
    properties: &[Property],
    tasks: &[Task],
    faults: &mut Faults,
) {
    let Some(Condition { property, values, text }) = &signal.when else { return };
    let parameters = meta.parameters.iter().map(|parameter| parameter.setting.name.value.as_str());
    let names: Vec<&str> = properties.iter().map(|p| p.setting.name.value.as_str()).chain(parameters).collect();
    if !names.contains(&property.as_str()) {
        let found = format!("a condition on a property {property:?}, which is not there");
        let fault = text.fault(found, format!("expected a property of this prototype: {}", one_of(&names)));
        faults.push(fault.did_you_mean(nearest(property, names)));
        return;
    }
    let Some(words) = choice_behind(property, properties, tasks) else { return };
    for value in values.iter().filter(|value| !words.contains(&value.as_str())) {
        let found = format!("{property:?} is never {value:?}");
        let fault = text.fault(found, format!("expected {}", one_of(words)));
        faults.push(fault.did_you_mean(nearest(value, words.iter().copied())));
    }
}

/// The words that the property called `name` can be, where it sets a choice.
fn choice_behind(name: &str, properties: &[Property], tasks: &[Task]) -> Option<&'static [&'static str]> {
    let index = properties.iter().position(|property| property.setting.name.value == name)?;
    tasks.iter().find_map(|task| {
        let from_it =
            |(_, assignment): &&(usize, Assignment)| matches!(assignment, Assignment::Property(p) if *p == index);
        let (parameter, _) = task.assignments.iter().find(from_it)?;
        match task.kind.parameters[*parameter].ty {
            ParameterType::Choice(words) => Some(words),
            _ => None,
        }
    })
}

/// The ports that a signal is bound to; faults for maps that lead to none.
pub(super) fn bindings(signal: &SignalDeclaration, tasks: &[Task], faults: &mut Faults) -> Vec<(usize, usize)> {
    let mut bindings = Vec::new();
    for map in &signal.maps {
        let Some(task) = task(tasks, map, faults) else { continue };
        let kind = tasks[task].kind;
        let Some(port) = kind.port(&map.property.value) else {
            let of_direction = kind.ports.iter().filter(|port| port.direction == signal.direction);
            let names = of_direction.map(|port| port.name);
            let found = match kind.parameter(&map.property.value) {
                Some(_) => format!("{:?} of {} is a property's, not a signal's", map.property.value, kind.name),
                None => format!("{} has no signal {:?}", kind.name, map.property.value),
            };
            let fault = map.property.fault(found, format!("expected {}", one_of(names.clone())));
            faults.push(fault.did_you_mean(nearest(&map.property.value, names)));
            continue;
        };
        if leads_right(signal, &kind.ports[port], map, kind, faults) {
            bindings.push((task, port));
        }
    }
    bindings
}

fn leads_right(
    signal: &SignalDeclaration,
    port: &PortDescriptor,
    map: &Map,
    kind: &KindDescriptor,
    faults: &mut Faults,
) -> bool {
    let before = faults.iter().count();
    if port.direction != signal.direction {
        let (is, what) = match port.direction {
            Direction::Command => ("is set by the automation", "expected an <input> here"),
            Direction::Report => ("is reported by the plant", "expected an <output> here"),
        };
        faults.push(map.property.fault(format!("{:?} of {} {is}", port.name, kind.name), what));
    }
    let (fits, types) = fitting_types(port.ty, signal.ty.value);
    if !fits {
        let found = format!("{:?} is declared as {}", signal.name.value, signal.ty.value);
        let expected = format!("expected {types}, as {} of {} is", port.name, kind.name);
        faults.push(signal.ty.fault(found, expected));
    }
    let element = signal.ty.value.element;
    if let (true, Some((low, high)), Some((least, greatest))) = (fits, element.integer_range(), port.range)
        && (least < low as f64 || greatest > high as f64)
    {
        let found = format!("{element} holds {low} to {high}");
        let expected =
            format!("expected a type that holds {least} to {greatest}, as {} of {} needs", port.name, kind.name);
        faults.push(signal.ty.fault(found, expected));
    }
    if let Some(unit) = &signal.unit
        && !port.quantities.contains(&unit.value.quantity)
    {
        let found = format!("{:?} is declared in {}", signal.name.value, unit.value);
        let symbols = super::quantity::symbols(port.quantities);
        faults.push(unit.fault(found, format!("expected {}", one_of(symbols))));
    }
    faults.iter().count() == before
}

/// Whether a signal's type fits a port, and the types that do.
fn fitting_types(port: PortType, signal: SignalType) -> (bool, &'static str) {
    let element = signal.element;
    let (fits, types) = match port {
        PortType::Boolean => (element == ElementaryType::Bool, "BOOL"),
        PortType::Integer => (element.integer_range().is_some(), "an integer type"),
        PortType::Real => (element.is_real(), "REAL or LREAL"),
    };
    (fits && signal.length.is_none(), types)
}
