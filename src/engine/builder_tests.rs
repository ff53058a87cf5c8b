//! Prototypes whose shape a script builds, and parameters that a script gives values to.

use std::sync::Arc;

use super::shape_fixture;
use crate::plant::Plant;
use crate::scene::Scene;

const INSIDE: &str = r#"  <property name="generator" value="builder.js" type="string"/>
  <parameter name="width" type="double" value="800" unit="mm">
    <property name="affectGeometry" value="true" type="boolean"/>
    <property name="constraints" value=">0, &lt;3000" type="string"/>
  </parameter>
  <parameter name="posts" type="double[]" value="0;0.4" unit="m">
    <property name="affectGeometry" value="true" type="boolean"/>
  </parameter>
  <parameter name="rise" type="double" value="0" unit="m">
    <property name="affectGeometry" value="true" type="boolean"/>
  </parameter>"#;

const BUILDER: &str = "// A gate that rises.
function build({ width, posts, rise }) {
  for (const x of posts)
    cylinder({ radius: 0.02, height: 1, at: [x, 0, 0], segments: 24 });
  const slide = frame('Spintore', { joint: { type: 'prismatic', axis: [0, 0, 1], min: 0, max: rise } });
  box({ size: [width, 0.02, 0.5], at: [width / 2, 0, 0.25], frame: slide, colour: [200, 40, 40] });
  extrude({ outline: [[0, 0], [0.1, 0], [0, 0.1]], height: 0.01, frame: slide, solid: false });
}
";

const CUSTOMIZER: &str = "function customize(parameters) {\n  return { rise: parameters.width / 2 };\n}\n";

const PLANT: &str = r#"<plant name="p">
  <instance name="A" prototype="Gate"/>
  <instance name="B" prototype="Gate"><property name="posts" value="0;200;400;600 mm"/></instance>
  <instance name="C" prototype="Gate"><property name="speed" value="1 m/s"/></instance>
  <instance name="D" prototype="Gate"><property name="rise" value="2 m"/></instance>
</plant>"#;

/// The model with some of its prototype's files changed.
fn model(changes: &[(&str, &str)]) -> Result<Plant, String> {
    let meta = shape_fixture::pusher("Gate", INSIDE, "${rise}");
    let files = [("prototype.xml", meta.as_str()), ("builder.js", BUILDER), ("customizer.js", CUSTOMIZER)];
    let files: Vec<(&str, &str)> = files.into_iter().chain(changes.iter().copied()).collect();
    shape_fixture::model(PLANT, "Gate", &files)
}

#[test]
fn a_builder_builds_from_the_parameters_and_once_for_all_that_are_alike() {
    let plant = model(&[]).expect("a plant");
    let scene = Scene::of(&plant);
    let bodies = |name: &str| {
        let of = scene.nodes().iter().filter(|node| node.name == name || node.name.starts_with(&format!("{name}.")));
        let instance = of.map(|node| node.instance).next().expect(name);
        scene.bodies().iter().filter(|body| scene.node(body.node).instance == instance).count()
    };
    assert_eq!((bodies("A"), bodies("B")), (4, 6));
    let structure = |index: usize| plant.instances[index].structure.clone().expect("a structure");
    assert!(Arc::ptr_eq(&structure(0), &structure(2)), "the speed does not affect the geometry");
    assert!(!Arc::ptr_eq(&structure(0), &structure(1)));
    for mesh in scene.meshes() {
        assert_eq!(mesh.open_edges(), 0, "{}", mesh.name);
        assert!(mesh.volume() > 0.0, "{}", mesh.name);
    }
}

#[test]
fn a_customizer_gives_values_to_what_an_instance_leaves_alone() {
    let plant = model(&[]).expect("a plant");
    let stroke = |index: usize| plant.instances[index].tasks[0].parameters.number("stroke");
    assert_eq!((stroke(0), stroke(3)), (0.4, 2.0));
    let scene = Scene::of(&plant);
    let limits = |name: &str| scene.node(scene.find_joint(name).expect(name)).joint.limits;
    assert_eq!((limits("A.Spintore.T"), limits("D.Spintore.T")), ([0.0, 0.4], [0.0, 2.0]));
}

#[test]
fn a_script_that_is_wrong_is_told_with_its_line_and_nothing_is_loaded() {
    let check = |file: &str, from: &str, to: &str, expect: &str| {
        let text = if file == "builder.js" { BUILDER } else { CUSTOMIZER };
        assert!(text.contains(from), "{from}");
        let error = model(&[(file, &text.replacen(from, to, 1))]).err().unwrap_or_else(|| panic!("{to} was taken"));
        assert!(error.contains(&format!("m/prototypes/Gate/{file}:{expect}")), "{to}: {error}");
    };
    let endless = model(&[("builder.js", "function build() { for (;;) {} }")]).expect_err("no shape");
    assert!(endless.contains("it does not end"), "{endless}");
    check("builder.js", "radius: 0.02", "radius: -1", "4:1: radius is -1: expected more than 0");
    check("builder.js", "radius: 0.02", "radius: 'x'", "4:1: radius is x: expected a finite number");
    check("builder.js", "radius: 0.02", "radius: 0/0", "4:1: radius is NaN: expected a finite number");
    check("builder.js", "segments: 24", "sides: 24", "4:1: lathe has no option sides");
    check("builder.js", "axis: [0, 0, 1]", "axis: [0, 0, 0]", "5:1: axis is 0,0,0");
    check("builder.js", "axis: [0, 0, 1], ", "", "5:1: a joint without an axis");
    check("builder.js", "frame: slide, colour", "frame: 'Slide', colour", "6:1: there is no frame Slide");
    check("builder.js", "[0.1, 0], [0, 0.1]", "[0.1, 0], [0.2, 0]", "1:1: extrude: the outline has no area");
    check("builder.js", "width / 2, 0", "length / 2, 0", "6:1: length is not defined");
    check("builder.js", "function build", "function construct", "1:1: there is no function build");
    check("customizer.js", "rise:", "raise:", "1:1: customize gave \"raise\"");
    check("customizer.js", "parameters.width", "parameters.width.mm.x", "2:1: ");
    let other = shape_fixture::pusher("Gate", &INSIDE.replace("builder.js", "other.js"), "${rise}");
    let error = model(&[("prototype.xml", &other)]).expect_err("no script");
    assert!(error.contains("there is no file m/prototypes/Gate/other.js"), "{error}");
    let error = model(&[("customizer.js", "function customize() { return { width: 4 }; }")]).expect_err("too wide");
    assert!(error.contains("is out of range: expected <3000"), "{error}");
}
