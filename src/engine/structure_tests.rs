//! Prototypes whose shape is in files: frames, joints and meshes of `structure.xml`.

use std::sync::Arc;
use std::time::Duration;

use super::{Engine, shape_fixture};
use crate::kinematics::DVec3;
use crate::plant::Plant;
use crate::scene::Scene;

const REACH: &str = r#"  <parameter name="reach" type="double" value="800" unit="mm">
    <property name="affectGeometry" value="true" type="boolean"/>
  </parameter>"#;

const STRUCTURE: &str = r#"<structure>
  <frame name="Plate" parent="Spintore">
    <pose z="100 mm"/>
    <mesh file="plate.obj" unit="mm" colour="10;20;30" solid="false"/>
  </frame>
  <frame name="Spintore">
    <joint type="prismatic" axis="2;0;0" min="0" max="${reach}"/>
    <mesh file="plate.obj" unit="mm"/>
  </frame>
</structure>"#;

const PLANT: &str = r#"<plant name="p">
  <instance name="A" prototype="Slider"><pose x="1"/></instance>
  <instance name="B" prototype="Slider"><pose y="2" rz="90deg"/></instance>
  <instance name="C" prototype="Slider"><pose y="4"/><property name="reach" value="0.3 m"/></instance>
</plant>"#;

const PLATE: &str = "v 0 0 0\nv 100 0 0\nv 0 100 0\nv 0 0 100\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

/// The model with other texts of its structure and of its mesh.
fn model(structure: &str, plate: &str) -> Result<Plant, String> {
    let meta = shape_fixture::pusher("Slider", REACH, "${reach}");
    let files = [("prototype.xml", meta.as_str()), ("structure.xml", structure), ("plate.obj", plate)];
    shape_fixture::model(PLANT, "Slider", &files)
}

fn structure(from: &str, to: &str) -> Result<Plant, String> {
    assert!(STRUCTURE.contains(from), "{from}");
    model(&STRUCTURE.replacen(from, to, 1), PLATE)
}

#[test]
fn frames_of_a_file_follow_the_device_and_meshes_are_read_once() {
    let plant = model(STRUCTURE, PLATE).expect("a plant");
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
    check("plate.obj\" unit=\"mm\"/>", "plate.step\" unit=\"mm\"/>", "there is no file m/prototypes/Slider/plate.step");
    check("10;20;30", "10;20;300", "\"10;20;300\" is no colour");
    check("100 mm", "100 N", "\"100 N\"");
    check("name=\"Plate\"", "name=\"Spintore\"", "two frames are called \"Spintore\"");
    let torn = model(STRUCTURE, &PLATE.replace("100", "NaN")).expect_err("no plant");
    assert!(torn.contains("m/prototypes/Slider/plate.obj:2: the coordinate \"NaN\""), "{torn}");
}
