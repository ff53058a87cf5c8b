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
  const welded = weld(places);
  const faces = faceNormals(places, corners);
  const { from, about } = facesAbout(welded, corners);
  const drawn = new Drawn(welded.length, corners.length);
  const index = new Uint32Array(corners.length);
  for (let i = 0; i < corners.length; i++) {
    const own = 4 * Math.floor(i / 3);
    const [x, y, z, size] = [faces[own]!, faces[own + 1]!, faces[own + 2]!, faces[own + 3]!];
    let nx = 0, ny = 0, nz = 0;
    const vertex = welded[corners[i]!]!;
    for (let j = from[vertex]!; j < from[vertex + 1]!; j++) {
      const other = 4 * about[j]!;
      const ox = faces[other]!, oy = faces[other + 1]!, oz = faces[other + 2]!;
      if (x * ox + y * oy + z * oz >= CREASE * size * faces[other + 3]!) {
        nx += ox;
        ny += oy;
        nz += oz;
      }
    }
    index[i] = drawn.vertex(places, vertex, nx, ny, nz);
  }
  const made = new BufferGeometry();
  made.setAttribute("position", new BufferAttribute(drawn.places.slice(0, 3 * drawn.count), 3));
  made.setAttribute("normal", new BufferAttribute(drawn.normals.slice(0, 3 * drawn.count), 3));
  made.setIndex(new BufferAttribute(index, 1));
  made.computeBoundingBox();
  made.computeBoundingSphere();
  return made;
}

/** Of each face its normal and that one's length, twice its area: a large face counts for more. */
function faceNormals(places: Float32Array, corners: Uint32Array): Float32Array {
  const faces = new Float32Array((corners.length / 3) * 4);
  for (let f = 0; f < corners.length / 3; f++) {
    const a = corners[f * 3]! * 3, b = corners[f * 3 + 1]! * 3, c = corners[f * 3 + 2]! * 3;
    const ux = places[b]! - places[a]!, uy = places[b + 1]! - places[a + 1]!, uz = places[b + 2]! - places[a + 2]!;
    const vx = places[c]! - places[a]!, vy = places[c + 1]! - places[a + 1]!, vz = places[c + 2]! - places[a + 2]!;
    const x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
    faces[f * 4] = x;
    faces[f * 4 + 1] = y;
    faces[f * 4 + 2] = z;
    // Math.hypot takes many times as long.
    faces[f * 4 + 3] = Math.sqrt(x * x + y * y + z * z);
  }
  return faces;
}

/** The faces about each vertex: those of vertex v are `about[from[v]]` to `about[from[v + 1] - 1]`. */
function facesAbout(welded: Uint32Array, corners: Uint32Array): { from: Uint32Array; about: Uint32Array } {
  const from = new Uint32Array(welded.length + 1);
  for (let i = 0; i < corners.length; i++) from[welded[corners[i]!]! + 1]!++;
  for (let v = 0; v < welded.length; v++) from[v + 1]! += from[v]!;
  const next = from.slice();
  const about = new Uint32Array(corners.length);
  for (let i = 0; i < corners.length; i++) about[next[welded[corners[i]!]!]!++] = Math.floor(i / 3);
  return { from, about };
}

/** The vertices that are drawn: a vertex of the mesh and a normal, rounded to a hundredth, are one. */
class Drawn {
  count = 0;
  readonly places: Float32Array;
  readonly normals: Float32Array;
  private readonly rounded: Uint32Array;
  /** The drawn ones of a vertex are a chain; 0 ends it, others are one more than their place. */
  private readonly first: Uint32Array;
  private readonly next: Uint32Array;

  constructor(vertices: number, corners: number) {
    [this.places, this.normals] = [new Float32Array(3 * corners), new Float32Array(3 * corners)];
    [this.rounded, this.first, this.next] = [new Uint32Array(corners), new Uint32Array(vertices), new Uint32Array(corners)];
  }

  /** The place of the one of `vertex` with the normal along (x, y, z), which may be new. */
  vertex(places: Float32Array, vertex: number, x: number, y: number, z: number): number {
    const length = Math.sqrt(x * x + y * y + z * z) || 1;
    const nx = x / length, ny = y / length, nz = z / length;
    const rounded = (Math.round(nx * 100) + 100) * 40401 + (Math.round(ny * 100) + 100) * 201 + Math.round(nz * 100) + 100;
    for (let known = this.first[vertex]!; known > 0; known = this.next[known - 1]!) {
      if (this.rounded[known - 1] === rounded) return known - 1;
    }
    const made = this.count++;
    this.rounded[made] = rounded;
    this.next[made] = this.first[vertex]!;
    this.first[vertex] = made + 1;
    for (let k = 0; k < 3; k++) this.places[made * 3 + k] = places[vertex * 3 + k]!;
    this.normals[made * 3] = nx;
    this.normals[made * 3 + 1] = ny;
    this.normals[made * 3 + 2] = nz;
    return made;
  }
}

/** Of each vertex the first at the same place. */
function weld(places: Float32Array): Uint32Array {
  const count = places.length / 3;
  const first = new Uint32Array(count);
  // An open table of twice as many places, a power of two; 0 is free, others are one more than their vertex.
  const mask = 2 ** Math.ceil(Math.log2(2 * count + 1)) - 1;
  const table = new Uint32Array(mask + 1);
  // -0 is 0, and adding 0 makes it so.
  const plain = places.map((place) => place + 0);
  const bits = new Uint32Array(plain.buffer);
  for (let v = 0; v < count; v++) {
    const a = bits[v * 3]!, b = bits[v * 3 + 1]!, c = bits[v * 3 + 2]!;
    let at = Math.imul(Math.imul(Math.imul(a, 0x9e3779b1) ^ b, 0x85ebca6b) ^ c, 0xc2b2ae35);
    at = (at ^ (at >>> 15)) & mask;
    for (; ; at = (at + 1) & mask) {
      const seen = table[at]! - 1;
      if (seen < 0) {
        table[at] = v + 1;
        first[v] = v;
        break;
      }
      if (bits[seen * 3] === a && bits[seen * 3 + 1] === b && bits[seen * 3 + 2] === c) {
        first[v] = seen;
        break;
      }
    }
  }
  return first;
}
