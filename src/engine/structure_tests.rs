//! Prototypes whose shape is in files: frames, joints and meshes of `structure.xml`.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Duration;

use super::Engine;
use crate::device::KINDS;
use crate::kinematics::DVec3;
use crate::plant::{Plant, load};
use crate::prototype::source::Memory;
use crate::scene::Scene;

const META: &str = r#"<prototype uuid="4ff5367a-4b69-48fb-9b2a-71e77d075c70" name="Slider" version="1">
  <property name="displayName" value="Slider" type="string"/>
  <property name="vendor" value="test" type="string"/>
  <parameter name="reach" type="double" value="800" unit="mm">
    <property name="affectGeometry" value="true" type="boolean"/>
  </parameter>
  <parameter name="speed" type="double" value="0.5" unit="m/s"/>
  <logics type="kinetwin.Pusher">
    <param name="stroke" type="double">${reach}</param>
    <param name="extendSpeed" type="double">${speed}</param>
  </logics>
</prototype>"#;

const STRUCTURE: &str = r#"<structure>
  <frame name="Plate" parent="Spintore">
    <pose z="100 mm"/>
    <mesh file="../plate.obj" unit="mm" colour="10;20;30" solid="false"/>
  </frame>
  <frame name="Spintore">
    <joint type="prismatic" axis="2;0;0" min="0" max="${reach}"/>
    <mesh file="../plate.obj" unit="mm"/>
  </frame>
</structure>"#;

const PLANT: &str = r#"<plant name="p">
  <instance name="A" prototype="Slider"><pose x="1"/></instance>
  <instance name="B" prototype="Slider"><pose y="2" rz="90deg"/></instance>
  <instance name="C" prototype="Slider"><pose y="4"/><property name="reach" value="0.3 m"/></instance>
</plant>"#;

const PLATE: &str = "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

fn model(change: impl Fn(&mut BTreeMap<String, String>)) -> Result<Plant, String> {
    let mut files = BTreeMap::from([
        ("m/plant.xml", PLANT),
        ("m/prototypes/Slider/prototype.xml", META),
        ("m/prototypes/Slider/structure.xml", STRUCTURE),
        ("m/prototypes/plate.obj", PLATE),
    ])
    .into_iter()
    .map(|(path, text)| (path.to_owned(), text.to_owned()))
    .collect();
    change(&mut files);
    load(&Memory(files), "m", KINDS).map_err(|error| error.to_string())
}

fn structure(from: &str, to: &str) -> Result<Plant, String> {
    model(|files| {
        let text = files.get_mut("m/prototypes/Slider/structure.xml").expect("it");
        assert!(text.contains(from), "{from}");
        *text = text.replacen(from, to, 1);
    })
}

#[test]
fn frames_of_a_file_follow_the_device_and_meshes_are_read_once() {
    let plant = model(|_| {}).expect("a plant");
    let scene = Scene::of(&plant);
    assert_eq!((scene.meshes().len(), scene.bodies().len()), (1, 6));
    let joint = |name: &str| scene.node(scene.find_joint(name).expect(name)).joint;
    assert_eq!((joint("A.Spintore.T").limits, joint("C.Spintore.T").limits), ([0.0, 0.8], [0.0, 0.3]));
    assert_eq!(joint("A.Spintore.T").axis, DVec3::X);
    let alike = |a: usize, b: usize| {
        let of = |index: usize| plant.instances[index].structure.clone().expect("a structure");
        Arc::ptr_eq(&of(a), &of(b))
    };
    assert!(alike(0, 1) && !alike(0, 2));

    let mut engine = Engine::new(&plant, Duration::from_millis(10), 0).expect("an engine");
    engine.show(&plant, Arc::new(scene));
    let mut poses = engine.poses().expect("shown").clone();
    let slide = poses.scene().find_joint("B.Spintore.T").expect("a joint");
    poses.set(slide, 0.5);
    poses.resolve();
    let plate = poses.scene().find("B.Plate").expect("a frame");
    assert!((poses.world(plate).translation - DVec3::new(0.0, 2.5, 0.1)).length() < 1e-12);
}

#[test]
fn a_wrong_structure_is_told_with_its_line_and_nothing_is_loaded() {
    let check = |from: &str, to: &str, expect: &str| {
        let error = structure(from, to).err().unwrap_or_else(|| panic!("{to} was taken"));
        assert!(error.contains(expect), "{to}: {error}");
        assert!(error.contains("m/prototypes/Slider/structure.xml:"), "{error}");
    };
    check(
        "<frame name=\"Spintore\">",
        "<frame name=\"Spintore\" parent=\"Plate\">",
        "stands in itself, by way of its parents",
    );
    check("parent=\"Spintore\"", "parent=\"Spindel\"", "there is no frame \"Spindel\": expected Plate or Spintore");
    check(" axis=\"2;0;0\"", "", "structure.xml:7:6: a joint without an axis");
    check("2;0;0", "0;0;0", "\"0;0;0\" is no axis");
    check("2;0;0", "1;0", "\"1;0\" is no axis");
    check("prismatic", "ball", "fixed, prismatic or revolute");
    check("${reach}", "${speed}", "there is no parameter \"speed\" that affects the geometry");
    check("${reach}", "-1", "a joint from 0 to -1");
    check("unit=\"mm\"/>", "/>", "a mesh in no unit");
    check("unit=\"mm\"/>", "unit=\"kg\"/>", "kg");
    check("plate.obj\" unit=\"mm\"/>", "plate.step\" unit=\"mm\"/>", "there is no file m/prototypes/plate.step");
    check("10;20;30", "10;20;300", "\"10;20;300\" is no colour");
    check("100 mm", "100 N", "\"100 N\"");
    check("name=\"Plate\"", "name=\"Spintore\"", "two frames are called \"Spintore\"");
    let torn = model(|files| drop(files.insert("m/prototypes/plate.obj".to_owned(), PLATE.replace("100", "NaN"))));
    let torn = torn.expect_err("no plant");
    assert!(torn.contains("m/prototypes/plate.obj:2: the coordinate \"NaN\""), "{torn}");
}
