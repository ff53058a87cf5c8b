//! One instance: what is set about it is worked out, its tasks get their parameters, its signals their registers.

use std::collections::BTreeMap;

use super::assemble::Tolerances;
use super::file::{InstanceDeclaration, PropertyDeclaration};
use serde_json::Value;

use super::parameter::{Refused, parse, quantities_of};
use super::shapes::{json, of_script};
use super::{Instance, Parameter, ParameterValue, Parameters, Task};
use crate::prototype::avatar::{Condition, SignalDeclaration};
use crate::prototype::basic::{BasicElement, parse_boolean};
use crate::prototype::builder;
use crate::prototype::kind::{ParameterDescriptor, ParameterType};
use crate::prototype::quantity::{from_si, parse_numbers, si_unit, to_si, with_unit};
use crate::prototype::setting::Setting;
use crate::prototype::{self, Assignment, Prototype, substitute};
use crate::script::ScriptError;
use crate::signal_map::{Kind, RegisterId, Signal};
use crate::value::{ElementaryType, Quantity, Unit};
use crate::xml::{Fault, Faults, Located, Place, nearest, one_of};

/// An instance and what it says where.
pub(super) struct Built {
    pub instance: Instance,
    /// The parameters that affect its geometry, as texts with their units.
    pub geometry: BTreeMap<String, String>,
    /// The instances that it names.
    pub references: Vec<Located<String>>,
    /// The parameters of its tasks that the plant's file sets.
    pub set: Vec<(&'static str, Place)>,
}

/// What something that can be set has as its value.
#[derive(Clone)]
struct Resolved {
    text: Located<String>,
    /// Whether the plant's file says so.
    is_set: bool,
    /// The unit of a number without one.
    unit: Option<Unit>,
    /// The tolerance that the instance gives it.
    set_tolerance: Option<f64>,
    /// The tolerance that its prototype declares.
    declared_tolerance: Option<f64>,
}

/// Builds an instance and appends its signals to `signals`, where a signal's place is its register.
pub(super) fn build(
    declaration: &InstanceDeclaration,
    prototype: &Prototype,
    tolerances: Tolerances,
    signals: &mut Vec<Located<Signal>>,
    faults: &mut Faults,
) -> Built {
    refuse_unknown(declaration, prototype, faults);
    let settings = Settings::resolve(declaration, prototype, tolerances, faults);
    let (mut references, mut set) = (Vec::new(), Vec::new());
    let mut tasks: Vec<Task> = prototype
        .tasks
        .iter()
        .map(|task| Task {
            name: task.name.value.clone(),
            kind: task.kind,
            parameters: settings.parameters(task, &mut references, &mut set, faults),
            ports: vec![None; task.kind.ports.len()],
        })
        .collect();
    for signal in &prototype.signals {
        if !settings.hold(signal.declaration.when.as_ref()) {
            continue;
        }
        let register = RegisterId(signals.len() as u32);
        for (task, port) in &signal.bindings {
            let bound = &mut tasks[*task].ports[*port];
            if bound.is_some() {
                let name = &signal.declaration.name;
                let port = tasks[*task].kind.ports[*port].name;
                let found = format!("{:?} is mapped to {port}, which has a signal already", name.value);
                faults.push(name.fault(found, "expected one signal for each property of a task"));
                continue;
            }
            *bound = Some(register);
        }
        let signal = settings.signal(signal, &tasks, faults);
        signals.push(signal);
    }
    let instance = Instance {
        name: declaration.name.value.clone(),
        prototype: prototype.meta.name.value.clone(),
        pose: declaration.pose.unwrap_or_default(),
        tasks,
        shape: settings.shape(),
        structure: None,
        effects: declaration.effects.iter().map(|effect| effect.spec.clone()).collect(),
    };
    Built { geometry: settings.geometry(), instance, references, set }
}

fn refuse_unknown(declaration: &InstanceDeclaration, prototype: &Prototype, faults: &mut Faults) {
    for property in &declaration.properties {
        let names: Vec<&str> = prototype.settings().map(|setting| setting.name.value.as_str()).collect();
        let name = &property.name;
        if !names.contains(&name.value.as_str()) {
            let found = format!("{} has no property {:?}", prototype.meta.name.value, name.value);
            let fault = name.fault(found, format!("expected {}", one_of(&names)));
            faults.push(fault.did_you_mean(nearest(&name.value, names)));
        }
    }
}

/// What can be set about one instance, worked out.
struct Settings<'a> {
    instance: &'a str,
    prototype: &'a Prototype,
    tolerances: Tolerances,
    /// Of each parameter of the meta-descriptor, in its order.
    parameters: Vec<Resolved>,
    /// Of each property of the avatar, in its order.
    properties: Vec<Resolved>,
}

impl<'a> Settings<'a> {
    fn resolve(
        declaration: &'a InstanceDeclaration,
        prototype: &'a Prototype,
        tolerances: Tolerances,
        faults: &mut Faults,
    ) -> Settings<'a> {
        let set = |setting: &Setting| declaration.properties.iter().find(|p| p.name.value == setting.name.value);
        let instance = declaration.name.value.as_str();
        let mut settings = Settings { instance, prototype, tolerances, parameters: Vec::new(), properties: Vec::new() };
        for parameter in &prototype.meta.parameters {
            let mut resolved = of_instance_or_default(&parameter.setting, set(&parameter.setting));
            refuse_violation(&parameter.setting, &resolved, faults);
            // The number takes its unit along to where it is handed on.
            resolved.text.value = with_unit(&resolved.text.value, parameter.setting.unit);
            settings.parameters.push(resolved);
        }
        settings.customize(faults);
        for property in &prototype.properties {
            let hidden = prototype.meta.parameters.iter().any(|p| p.setting.name.value == property.setting.name.value);
            let resolved = match set(&property.setting).filter(|_| !hidden) {
                Some(set) => of_instance_or_default(&property.setting, Some(set)),
                None => settings.own(&property.setting),
            };
            let resolved = Resolved { text: boolean_in_words(&property.setting, resolved.text, faults), ..resolved };
            settings.properties.push(resolved);
        }
        settings
    }

    /// Lets the prototype's `customizer.js` give values to what the instance does not set.
    fn customize(&mut self, faults: &mut Faults) {
        let Some(script) = &self.prototype.customizer else { return };
        let parameters = self.shape().iter().map(|(name, value)| (name.clone(), json(value))).collect();
        let given = match builder::customize(script, &Value::Object(parameters)) {
            Ok(given) => given,
            Err(error) => return faults.push(of_script(script, &error)),
        };
        for (name, value) in given {
            let index = self.prototype.meta.parameters.iter().position(|p| p.setting.name.value == name);
            let text = match &value {
                Value::Number(number) => Some(number.to_string()),
                Value::Bool(value) => Some(value.to_string()),
                Value::String(text) => Some(text.clone()),
                Value::Array(items) => Some(items.iter().map(Value::to_string).collect::<Vec<_>>().join(";")),
                _ => None,
            };
            let (Some(index), Some(text)) = (index, text) else {
                let message = format!("customize gave {name:?} the value {value}: expected values of the parameters");
                faults.push(of_script(script, &ScriptError { line: None, message }));
                continue;
            };
            let resolved = &mut self.parameters[index];
            if resolved.is_set {
                continue;
            }
            let setting = &self.prototype.meta.parameters[index].setting;
            let si = setting.unit.map(|unit| si_unit(unit.quantity));
            resolved.text.value = if setting.ty.is_numeric() { with_unit(&text, si) } else { text };
            refuse_violation(setting, resolved, faults);
        }
    }

    /// The value of a setting that no instance sets: its default, references replaced.
    fn own(&self, setting: &Setting) -> Resolved {
        let find = |name: &str| {
            let index = self.prototype.meta.parameters.iter().position(|p| p.setting.name.value == name)?;
            self.parameters.get(index)
        };
        let text = &setting.default.value;
        // A default that is one reference and nothing else passes on where its value was written, and how exact it is.
        let passed_on = text.strip_prefix("${").and_then(|rest| rest.strip_suffix('}')).and_then(find);
        if let Some(parameter) = passed_on {
            let declared_tolerance = setting.tolerance.or(parameter.declared_tolerance);
            return Resolved { unit: setting.unit, declared_tolerance, ..parameter.clone() };
        }
        let replaced = substitute(text, self.instance, |name| find(name).map(|resolved| resolved.text.value.as_str()));
        // That every reference is there was checked with the prototype.
        let text = Located::new(replaced.unwrap_or_else(|_| text.clone()), &setting.default.place);
        let (unit, declared_tolerance) = (setting.unit, setting.tolerance);
        Resolved { text, is_set: false, unit, set_tolerance: None, declared_tolerance }
    }

    fn geometry(&self) -> BTreeMap<String, String> {
        let parameters = self.prototype.meta.parameters.iter().zip(&self.parameters);
        let affecting = parameters.filter(|(parameter, _)| parameter.affects_geometry);
        affecting
            .map(|(parameter, resolved)| (parameter.setting.name.value.clone(), resolved.text.value.clone()))
            .collect()
    }

    /// The parameters of the meta-descriptor as values. What is wrong with a text is told where it is used.
    fn shape(&self) -> BTreeMap<String, ParameterValue> {
        let parameters = self.prototype.meta.parameters.iter().zip(&self.parameters);
        let value = |(parameter, resolved): (&prototype::meta::Parameter, &Resolved)| {
            let Setting { name, ty, unit, .. } = &parameter.setting;
            let text = resolved.text.value.as_str();
            let value = match ty.element {
                BasicElement::Boolean if !ty.array => ParameterValue::Boolean(parse_boolean(text)?),
                _ if ty.is_numeric() => {
                    let quantity = unit.map_or(Quantity::One, |unit| unit.quantity);
                    let numbers = parse_numbers(text, *unit, &[quantity]).ok()?;
                    match numbers.as_slice() {
                        [number] if !ty.array => ParameterValue::Number(*number),
                        _ => ParameterValue::Numbers(numbers),
                    }
                }
                _ => ParameterValue::Text(text.to_owned()),
            };
            Some((name.value.clone(), value))
        };
        parameters.filter_map(value).collect()
    }

    /// Whether a signal's condition holds.
    fn hold(&self, condition: Option<&Condition>) -> bool {
        let Some(condition) = condition else { return true };
        let named = |setting: &Setting| setting.name.value == condition.property;
        let properties = self.prototype.properties.iter().map(|property| &property.setting).zip(&self.properties);
        let parameters = self.prototype.meta.parameters.iter().map(|p| &p.setting).zip(&self.parameters);
        let value = properties.chain(parameters).find(|(setting, _)| named(setting)).map(|(_, resolved)| resolved);
        value.is_some_and(|resolved| condition.values.iter().any(|value| value == resolved.text.value.trim()))
    }

    /// Every parameter of a task; the instances that they name are added to `references`, and those that the plant's file
    /// sets to `set`.
    fn parameters(
        &self,
        task: &prototype::Task,
        references: &mut Vec<Located<String>>,
        set: &mut Vec<(&'static str, Place)>,
        faults: &mut Faults,
    ) -> Parameters {
        let resolved: Vec<Resolved> = (0..task.kind.parameters.len())
            .map(|index| match task.assignments.iter().find(|(assigned, _)| *assigned == index) {
                Some((_, Assignment::Property(property))) => self.properties[*property].clone(),
                Some((_, Assignment::Own(setting))) => self.own(setting),
                None => {
                    let text = Located::new(task.kind.parameters[index].default.to_owned(), &task.name.place);
                    Resolved { text, is_set: false, unit: None, set_tolerance: None, declared_tolerance: None }
                }
            })
            .collect();
        let motion = task.kind.parameters.iter().position(|parameter| parameter.name == MOTION);
        let rotary = motion.is_some_and(|index| resolved[index].text.value.trim() == ROTARY);
        let mut parameters = Parameters::default();
        for (descriptor, resolved) in task.kind.parameters.iter().zip(&resolved) {
            let value = match parse(descriptor, &resolved.text.value, resolved.unit, rotary) {
                Ok(value) => value,
                // What violates the prototype's own constraint is told once.
                Err(_) if faults.any_at(&resolved.text.place) => continue,
                Err(refused) => {
                    faults.push(of_refused(refused, &resolved.text.place, descriptor, self.instance));
                    continue;
                }
            };
            if let (ParameterType::Instance, ParameterValue::Text(name)) = (descriptor.ty, &value)
                && !name.is_empty()
            {
                references.push(Located::new(name.clone(), &resolved.text.place));
            }
            if resolved.is_set {
                set.push((descriptor.name, resolved.text.place.clone()));
            }
            let Tolerances { plant, default } = self.tolerances;
            let tolerance = resolved.set_tolerance.or(plant).or(resolved.declared_tolerance).unwrap_or(default);
            parameters.0.insert(descriptor.name, Parameter { value, tolerance });
        }
        parameters
    }

    /// The signal as it stands in the map.
    fn signal(&self, signal: &prototype::Signal, tasks: &[Task], faults: &mut Faults) -> Located<Signal> {
        let declaration = &signal.declaration;
        let bound = signal.bindings.first().map(|(task, port)| (&tasks[*task], &tasks[*task].kind.ports[*port]));
        let unit = match bound {
            Some((task, port)) => {
                let quantities = quantities_of(port.quantities, is_rotary(task));
                if let Some(unit) = &declaration.unit
                    && !quantities.contains(&unit.value.quantity)
                {
                    let found =
                        format!("{:?} of {} is declared in {}", declaration.name.value, self.instance, unit.value);
                    let symbols = prototype::quantity::symbols(&quantities);
                    faults.push(unit.fault(found, format!("expected {}", one_of(symbols))));
                }
                quantities.first().map_or(Unit::ONE, |quantity| si_unit(*quantity))
            }
            None => Unit::ONE,
        };
        let unit = declaration.unit.as_ref().map_or(unit, |unit| unit.value);
        let range = bound.and_then(|(_, port)| port.range);
        let (min, max) = narrowed(declaration, range, unit, faults);
        let task_and_property = declaration.maps.first();
        let value = Signal {
            name: format!("{}.{}", self.instance, declaration.name.value),
            ty: declaration.ty.value,
            direction: declaration.direction,
            kind: declaration.kind.or(bound.map(|(_, port)| port.kind)).unwrap_or(default_kind(declaration)),
            rate: declaration.rate,
            unit,
            min,
            max,
            instance: self.instance.to_owned(),
            task: task_and_property.map(|map| map.task.value.clone()).unwrap_or_default(),
            property: task_and_property.map(|map| map.property.value.clone()).unwrap_or_default(),
        };
        Located::new(value, &declaration.name.place)
    }
}

/// The parameter by which a kind that can be either is linear or rotary, and its word for rotary.
const MOTION: &str = "motion";
const ROTARY: &str = "rotary";

fn is_rotary(task: &Task) -> bool {
    matches!(task.parameters.0.get(MOTION), Some(Parameter { value: ParameterValue::Text(word), .. }) if word == ROTARY)
}

fn of_instance_or_default(setting: &Setting, set: Option<&PropertyDeclaration>) -> Resolved {
    Resolved {
        text: set.map_or(&setting.default, |set| &set.value).clone(),
        is_set: set.is_some(),
        unit: setting.unit,
        set_tolerance: set.and_then(|set| set.tolerance),
        declared_tolerance: setting.tolerance,
    }
}

fn refuse_violation(setting: &Setting, resolved: &Resolved, faults: &mut Faults) {
    if let Some(constraint) = setting.violated(&resolved.text.value) {
        let found = format!("{:?} is out of range", resolved.text.value);
        let unit = setting.unit.map(|unit| format!(" {unit}")).unwrap_or_default();
        let expected = format!("expected {}{unit}, as {} is declared", constraint.text, setting.name.value);
        faults.push(resolved.text.fault(found, expected));
    }
}

/// A boolean as `true` or `false`, so that conditions need no second spelling.
fn boolean_in_words(setting: &Setting, text: Located<String>, faults: &mut Faults) -> Located<String> {
    if setting.ty.element != BasicElement::Boolean || setting.ty.array {
        return text;
    }
    match parse_boolean(&text.value) {
        Some(value) => Located::new(value.to_string(), &text.place),
        None => {
            faults.push(text.fault(format!("{:?} is no boolean", text.value), "expected true, false, 1 or 0"));
            text
        }
    }
}

fn of_refused(refused: Refused, place: &Place, descriptor: &ParameterDescriptor, instance: &str) -> Fault {
    let found = format!("{}.{}: {}", instance, descriptor.name, refused.found);
    place.fault(found, refused.expected).did_you_mean(refused.near)
}

/// A signal of an elementary type that nobody bound: coded values are edges, numbers are levels.
fn default_kind(declaration: &SignalDeclaration) -> Kind {
    match declaration.ty.value.element {
        ElementaryType::Real | ElementaryType::Lreal | ElementaryType::Time => Kind::Level,
        _ => Kind::Edge,
    }
}

/// The range of a signal in its unit: what its declaration says, within what its port allows.
fn narrowed(
    declaration: &SignalDeclaration,
    port: Option<(f64, f64)>,
    unit: Unit,
    faults: &mut Faults,
) -> (Option<f64>, Option<f64>) {
    let (least, greatest) = match port {
        Some((least, greatest)) => (Some(least), Some(greatest)),
        None => (None, None),
    };
    for bound in [&declaration.min, &declaration.max].into_iter().flatten() {
        let si = to_si(bound.value, unit);
        if least.is_some_and(|least| si < least) || greatest.is_some_and(|greatest| si > greatest) {
            let (least, greatest) = port.unwrap_or_default();
            let (least, greatest) = (from_si(least, unit), from_si(greatest, unit));
            let found = format!("{} is out of the device's range", bound.value);
            faults.push(bound.fault(found, format!("expected {least} to {greatest}")));
        }
    }
    let chosen = |declared: &Option<Located<f64>>, device: Option<f64>| {
        declared.as_ref().map(|bound| bound.value).or(device.map(|bound| from_si(bound, unit)))
    };
    (chosen(&declaration.min, least), chosen(&declaration.max, greatest))
}
