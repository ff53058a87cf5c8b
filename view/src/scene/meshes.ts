// The engine's meshes, as three.js draws them: with normals that keep edges sharp.

import { BufferAttribute, BufferGeometry } from "three";

/** The cosine of the angle up to which two faces are one surface to the eye: 40°. */
const CREASE = Math.cos((40 / 180) * Math.PI);

/** Reads `GET /api/meshes`. */
export function readMeshes(buffer: ArrayBuffer): BufferGeometry[] {
  const view = new DataView(buffer);
  let at = 4;
  return Array.from({ length: view.getUint32(0, true) }, () => {
    const [vertices, triangles] = [view.getUint32(at, true), view.getUint32(at + 4, true)];
    at += 8;
    const places = new Float32Array(buffer.slice(at, at + vertices * 12));
    at += vertices * 12;
    const corners = new Uint32Array(buffer.slice(at, at + triangles * 12));
    at += triangles * 12;
    return geometry(places, corners);
  });
}

/** What is drawn of a mesh: a corner's normal is that of the faces about it that are one surface with its own. */
export function geometry(places: Float32Array, corners: Uint32Array): BufferGeometry {
  const count = corners.length / 3;
  const vertices = places.length / 3;
  const faces = new Float32Array(count * 3);
  const welded = weld(places);
  const degree = new Uint32Array(vertices + 1);
  for (let f = 0; f < count; f++) {
    const [a, b, c] = [corners[f * 3]! * 3, corners[f * 3 + 1]! * 3, corners[f * 3 + 2]! * 3];
    const ux = places[b]! - places[a]!, uy = places[b + 1]! - places[a + 1]!, uz = places[b + 2]! - places[a + 2]!;
    const vx = places[c]! - places[a]!, vy = places[c + 1]! - places[a + 1]!, vz = places[c + 2]! - places[a + 2]!;
    // Not of length 1 yet: a large face counts for more.
    faces[f * 3] = uy * vz - uz * vy;
    faces[f * 3 + 1] = uz * vx - ux * vz;
    faces[f * 3 + 2] = ux * vy - uy * vx;
    for (let k = 0; k < 3; k++) degree[welded[corners[f * 3 + k]!]! + 1]!++;
  }
  for (let v = 0; v < vertices; v++) degree[v + 1]! += degree[v]!;
  const place = degree.slice();
  const about = new Uint32Array(count * 3);
  for (let i = 0; i < count * 3; i++) about[place[welded[corners[i]!]!]!++] = Math.floor(i / 3);
  // A vertex and a normal, rounded to a hundredth, are one vertex of what is drawn.
  const known = new Map<number, number>();
  const [out, normals]: [number[], number[]] = [[], []];
  const index = new Uint32Array(count * 3);
  for (let i = 0; i < count * 3; i++) {
    const own = Math.floor(i / 3) * 3;
    const [x, y, z] = [faces[own]!, faces[own + 1]!, faces[own + 2]!];
    const size = Math.hypot(x, y, z) || 1;
    let [nx, ny, nz] = [0, 0, 0];
    const vertex = welded[corners[i]!]!;
    for (let j = degree[vertex]!; j < degree[vertex + 1]!; j++) {
      const other = about[j]! * 3;
      const [ox, oy, oz] = [faces[other]!, faces[other + 1]!, faces[other + 2]!];
      const length = Math.hypot(ox, oy, oz);
      if (x * ox + y * oy + z * oz >= CREASE * size * length) {
        nx += ox;
        ny += oy;
        nz += oz;
      }
    }
    const length = Math.hypot(nx, ny, nz) || 1;
    [nx, ny, nz] = [nx / length, ny / length, nz / length];
    const rounded = (Math.round(nx * 100) + 100) * 40401 + (Math.round(ny * 100) + 100) * 201 + Math.round(nz * 100) + 100;
    const key = vertex * 8_200_000 + rounded;
    let drawn = known.get(key);
    if (drawn === undefined) {
      drawn = out.length / 3;
      known.set(key, drawn);
      out.push(places[vertex * 3]!, places[vertex * 3 + 1]!, places[vertex * 3 + 2]!);
      normals.push(nx, ny, nz);
    }
    index[i] = drawn;
  }
  const made = new BufferGeometry();
  made.setAttribute("position", new BufferAttribute(new Float32Array(out), 3));
  made.setAttribute("normal", new BufferAttribute(new Float32Array(normals), 3));
  made.setIndex(new BufferAttribute(index, 1));
  made.computeBoundingBox();
  made.computeBoundingSphere();
  return made;
}

/** Of each vertex the first at the same place. */
function weld(places: Float32Array): Uint32Array {
  const known = new Map<string, number>();
  const first = new Uint32Array(places.length / 3);
  for (let v = 0; v < first.length; v++) {
    const key = `${places[v * 3]},${places[v * 3 + 1]},${places[v * 3 + 2]}`;
    const seen = known.get(key);
    if (seen === undefined) known.set(key, v);
    first[v] = seen ?? v;
  }
  return first;
}
