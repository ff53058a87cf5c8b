//! Files as programs write them, and files that are none.

use super::*;

fn with(path: &str, bytes: &[u8], metres: Option<f64>) -> Result<Mesh, String> {
    let beside = |file: &str| Err(format!("there is no file {file}"));
    let reading = Reading { metres, up: None, simplify: 0.0 };
    read(path, bytes, reading, &beside).map_err(|error| error.to_string())
}

#[track_caller]
fn refused(path: &str, bytes: &[u8], expect: &str) {
    let error = with(path, bytes, Some(1.0)).expect_err("no mesh");
    assert!(error.contains(expect), "{error}");
}

/// A tetrahedron of volume 1/6 of the unit's cube.
const CORNERS: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const FACES: [[usize; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

fn ascii() -> String {
    let mut text = "solid part\n".to_owned();
    for face in FACES {
        text += "  facet normal 0 0 0\n    outer loop\n";
        for corner in face {
            let [x, y, z] = CORNERS[corner];
            text += &format!("      vertex {x:e} {y:e} {z:e}\n");
        }
        text += "    endloop\n  endfacet\n";
    }
    text + "endsolid part\n"
}

fn binary() -> Vec<u8> {
    // Some programs begin even a binary file's header so.
    let mut bytes = b"solid but binary".to_vec();
    bytes.resize(80, b' ');
    bytes.extend(4u32.to_le_bytes());
    for face in FACES {
        bytes.extend([0; 12]);
        face.iter().flat_map(|corner| CORNERS[*corner]).for_each(|x| bytes.extend(x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn obj() -> String {
    let mut text = "# a part\nmtllib none.mtl\no part\n".to_owned();
    CORNERS.iter().for_each(|[x, y, z]| text += &format!("v {x} {y} {z}\n"));
    FACES.iter().for_each(|[a, b, c]| text += &format!("f {}//1 {}//1 {}\n", a + 1, b + 1, *c as i64 - 4));
    text
}

fn gltf() -> String {
    use base64::Engine as _;
    let mut buffer: Vec<u8> = CORNERS.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    buffer.extend(FACES.iter().flatten().flat_map(|index| (*index as u16).to_le_bytes()));
    let data = base64::engine::general_purpose::STANDARD.encode(&buffer);
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"children":[1],"translation":[0,5,0]}},{{"mesh":0,"scale":[2,2,2]}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}},
                     {{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}}],
        "bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":48,"byteLength":24}}],
        "buffers":[{{"byteLength":72,"uri":"data:application/octet-stream;base64,{data}"}}]}}"#
    )
}

const VRML: &str = "#VRML V2.0 utf8
# exported
WorldInfo { title \"a \\\"part\\\"\" }
DEF Part Transform {
  translation 0 5 0
  scale 2 2 2
  children [
    Shape {
      appearance Appearance { material DEF Grey Material { diffuseColor 0.5, 0.5, 0.5 } }
      geometry DEF Faces IndexedFaceSet {
        solid TRUE
        coord Coordinate { point [ 0 0 0, 1 0 0, 0 1 0, 0 0 1 ] }
        coordIndex [ 0 2 1 -1, 0 1 3 -1, 0 3 2 -1, 1 2 3 ]
      }
    }
  ]
}
Transform { translation 0 0 9 rotation 0 0 1 1.5707963 children Shape { geometry USE Faces } }
Viewpoint { position 0 0 10 description \"front\" }
ROUTE Part.translation_changed TO Part.set_translation
";

#[track_caller]
fn check(mesh: Result<Mesh, String>, triangles: usize, volume: f64) -> Mesh {
    let mesh = mesh.expect("a mesh");
    assert_eq!((mesh.triangles.len(), mesh.open_edges()), (triangles, 0));
    assert!((mesh.volume() / volume - 1.0).abs() < 1e-6, "{} is not {volume}", mesh.volume());
    mesh
}

#[test]
fn every_format_gives_the_same_part() {
    let sixth = 1.0 / 6.0;
    let part = check(with("part.stl", ascii().as_bytes(), Some(1.0)), 4, sixth);
    assert_eq!(part.vertices.len(), 4, "equal corners are one vertex");
    check(with("part.STL", &binary(), Some(0.001)), 4, sixth * 1e-9);
    check(with("part.obj", obj().as_bytes(), Some(0.01)), 4, sixth * 1e-6);
    // The root lifts it by 5 along y, which is up.
    let up = check(with("part.gltf", gltf().as_bytes(), None), 4, sixth * 8.0);
    assert_eq!(up.bounds(), Some([[0.0, -2.0, 5.0], [2.0, 0.0, 7.0]]));
    let world = check(with("part.wrl", VRML.as_bytes(), None), 8, sixth * 9.0);
    let [low, high] = world.bounds().expect("vertices");
    let off = |found: [f32; 3], expected: [f32; 3]| (0..3).any(|axis| (found[axis] - expected[axis]).abs() > 1e-6);
    assert!(!off(low, [-1.0, -10.0, 0.0]) && !off(high, [2.0, 0.0, 7.0]), "{low:?} {high:?}");
}

#[test]
fn faces_of_many_corners_are_filled() {
    let cube = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
                f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    check(with("cube.obj", cube.as_bytes(), Some(1.0)), 12, 1.0);
}

#[test]
fn what_is_no_mesh_is_told_with_its_line() {
    refused("part.stl", b"<html>", "part.stl: this is no STL");
    refused("part.stl", &binary()[..200], "part.stl: a binary STL of 200 bytes that says it has 4 triangles");
    refused("part.stl", ascii().replacen("1e0", "NaN", 1).as_bytes(), "part.stl:5: the coordinate \"NaN\"");
    refused("part.stl", ascii().replacen("1e0", "l", 1).as_bytes(), "part.stl:5: \"l\" is no number");
    refused(
        "part.stl",
        ascii().replacen("    endloop\n  endfacet\nendsolid part\n", "", 1).as_bytes(),
        "ends within a facet",
    );
    refused("part.obj", obj().replacen("//1", "1//1", 1).as_bytes(), "part.obj:8: \"11//1\" names no vertex");
    refused("part.obj", b"v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n", "part.obj:4: triangle 1 has no area");
    refused("part.obj", b"v 0 0 inf\n", "part.obj:1: the coordinate \"inf\"");
    refused("part.obj", b"v 0 0 0\n", "part.obj: a file without a triangle");
    refused("part.obj", b"hello\n", "part.obj:1: \"hello\" is no statement");
    refused("part.gltf", b"{}", "part.gltf: this is no glTF");
    let torn = gltf().replace("\"byteLength\":24", "\"byteLength\":2400");
    refused("part.gltf", torn.as_bytes(), "reaches beyond its buffer");
    let circle = gltf().replace("\"mesh\":0,", "\"mesh\":0,\"children\":[0],");
    refused("part.gltf", circle.as_bytes(), "nodes under nodes without end");
    let far = gltf().replace("data:application/octet-stream", "part.bin?");
    refused("part.gltf", far.as_bytes(), "there is no file part.bin");
    refused("part.wrl", b"#VRML V1.0 ascii\n", "part.wrl:1: this is VRML 1.0");
    refused("part.wrl", VRML.replacen("0 0 1 ]", "0 0 nan ]", 1).as_bytes(), "part.wrl:12: the coordinate \"nan\"");
    refused("part.wrl", VRML.replacen("1 2 3 ]", "1 2 7 ]", 1).as_bytes(), "part.wrl:13: vertex 7");
    refused("part.wrl", VRML.replacen("USE Faces", "USE Faeces", 1).as_bytes(), "part.wrl:18: USE Faeces");
    refused("part.wrl", &VRML.as_bytes()[..VRML.len() / 2], "part.wrl:");
    let deep = format!("#VRML V2.0 utf8\n{}", "Group { children [ ".repeat(100_000));
    refused("part.wrl", deep.as_bytes(), "nodes within nodes without end");
    refused("part.step", b"ISO-10303-21;", "STEP describes surfaces, not triangles");
    refused("part.dwg", b"", "this is no format of meshes known here");
    let error = with("part.stl", ascii().as_bytes(), None).expect_err("no unit");
    assert!(error.contains("a mesh in no unit"), "{error}");
}

#[test]
fn a_simpler_mesh_is_nowhere_further_off_than_allowed() {
    let mut ball = Mesh::new("ball");
    let (rings, segments) = (60u32, 120u32);
    for ring in 0..=rings {
        let (height, radius) = (std::f64::consts::PI * f64::from(ring) / f64::from(rings)).sin_cos();
        for segment in 0..segments {
            let (y, x) = (std::f64::consts::TAU * f64::from(segment) / f64::from(segments)).sin_cos();
            ball.vertices.push([(x * height) as f32, (y * height) as f32, radius as f32]);
        }
    }
    for ring in 0..rings {
        for segment in 0..segments {
            let next = (segment + 1) % segments;
            let [a, b] = [ring * segments + segment, ring * segments + next];
            ball.triangles.extend([[a, a + segments, b + segments], [a, b + segments, b]]);
        }
    }
    let simple = ball.simplified(0.005);
    assert!(simple.triangles.len() * 3 < ball.triangles.len(), "{}", simple.triangles.len());
    assert!(ball.departure(&simple) <= 0.005 && simple.departure(&ball) <= 0.005);
}
