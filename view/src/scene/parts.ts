// Parts: boxes with their tape, pallets with their boards; as many as there are.

import { BoxGeometry, BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, Group, InstancedMesh, Material, Matrix4, Quaternion, Vector3 } from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import type { Colour } from "../api";
import type { PartMove } from "../stream";

const UP = new Vector3(0, 0, 1);

/** A cuboid about (x, y, z) of unit cube [-½, ½]² × [0, 1], tinted. */
function board(size: [number, number, number], place: [number, number, number], tint: number): BufferGeometry {
  const box = new BoxGeometry(...size).translate(...place);
  const colours = new Float32Array(box.getAttribute("position").count * 3).fill(tint);
  box.setAttribute("color", new BufferAttribute(colours, 3));
  return box;
}

/** A closed carton with a strip of tape along its top. */
function carton(): BufferGeometry {
  const tape = 1.18;
  return mergeGeometries([
    board([1, 1, 1], [0, 0, 0.5], 1),
    board([1.003, 0.14, 0.004], [0, 0, 1], tape),
    board([0.004, 0.14, 0.22], [0.5, 0, 0.892], tape),
    board([0.004, 0.14, 0.22], [-0.5, 0, 0.892], tape),
  ]);
}

/** A pallet: seven boards on three beams on three skids. */
function pallet(): BufferGeometry {
  const boards = Array.from({ length: 7 }, (_, i) => board([1, 0.115, 0.16], [0, -0.4425 + i * 0.1475, 0.92], 1));
  const beams = [-0.44, 0, 0.44].map((x) => board([0.12, 1, 0.16], [x, 0, 0.76], 0.9));
  const blocks = [-0.44, 0, 0.44].flatMap((x) => [-0.43, 0, 0.43].map((y) => board([0.12, 0.14, 0.54], [x, y, 0.41], 0.82)));
  const skids = [-0.43, 0, 0.43].map((y) => board([1, 0.14, 0.14], [0, y, 0.07], 0.9));
  return mergeGeometries([...boards, ...beams, ...blocks, ...skids]);
}

/** All parts of one kind. */
class Kind {
  mesh: InstancedMesh;
  private cast: InstancedMesh | null = null;
  /** The part of each place. */
  readonly numbers: number[] = [];

  constructor(
    private readonly geometry: BufferGeometry,
    private readonly material: Material,
    private readonly colour: Color,
    private readonly shadow: Material | null,
  ) {
    this.mesh = this.make(64);
  }

  private make(room: number): InstancedMesh {
    const mesh = new InstancedMesh(this.geometry, this.material, room);
    mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    mesh.frustumCulled = false;
    mesh.count = 0;
    return mesh;
  }

  /** Puts all parts of this kind anew. */
  put(parts: PartMove[], group: Group, shadows: Group, chosen: number | null, accent: Color): void {
    if (parts.length > this.mesh.instanceMatrix.count) {
      group.remove(this.mesh);
      if (this.cast) shadows.remove(this.cast);
      this.mesh.dispose();
      this.mesh = this.make(parts.length * 2);
    }
    if (!this.mesh.parent) {
      group.add(this.mesh);
      if (this.shadow) {
        this.cast = new InstancedMesh(this.geometry, this.shadow, this.mesh.instanceMatrix.count);
        this.cast.instanceMatrix = this.mesh.instanceMatrix;
        this.cast.frustumCulled = false;
        // Nobody points at a shadow.
        this.cast.raycast = () => {};
        shadows.add(this.cast);
      }
    }
    const [matrix, turn] = [new Matrix4(), new Quaternion()];
    parts.forEach((part, index) => {
      const [x, y, z, yaw] = part.place;
      matrix.compose(new Vector3(x, y, z), turn.setFromAxisAngle(UP, yaw), new Vector3(...part.size));
      this.mesh.setMatrixAt(index, matrix);
      this.mesh.setColorAt(index, part.number === chosen ? accent : this.colour);
      this.numbers[index] = part.number;
    });
    this.mesh.count = parts.length;
    if (this.cast) this.cast.count = parts.length;
    this.mesh.instanceMatrix.needsUpdate = true;
    if (this.mesh.instanceColor) this.mesh.instanceColor.needsUpdate = true;
    this.mesh.boundingSphere = null;
  }
}

/** All parts. */
export class Parts {
  readonly group = new Group();
  readonly shadows = new Group();
  readonly all = new Map<number, PartMove>();
  chosen: number | null = null;
  private readonly kinds: Kind[];
  private hides: (part: PartMove) => boolean = () => false;

  constructor(colours: Colour[], material: Material, shadow: Material | null) {
    const colour = ([r, g, b]: Colour) => new Color().setRGB(r / 255, g / 255, b / 255, "srgb");
    const shapes = [carton(), pallet()];
    this.kinds = shapes.map((shape, kind) => new Kind(shape, material, colour(colours[kind]!), shadow));
  }

  move(begins: boolean, moved: PartMove[], gone: number[]): void {
    if (!begins && moved.length === 0 && gone.length === 0) return;
    if (begins) this.all.clear();
    gone.forEach((number) => this.all.delete(number));
    moved.forEach((part) => this.all.set(part.number, part));
    this.put();
  }

  /** Hides parts that stand where one of `others` does. */
  onlyUnlike(others: Parts): void {
    const alike = (part: PartMove) =>
      [...others.all.values()].some((other) => other.kind === part.kind && other.place.every((number, index) => Math.abs(number - part.place[index]!) < 2e-3));
    this.hides = alike;
    this.put();
  }

  choose(number: number | null): void {
    if (number === this.chosen) return;
    this.chosen = number;
    this.put();
  }

  private put(): void {
    const accent = new Color("#18a7b5");
    const of = (kind: number) => [...this.all.values()].filter((part) => part.kind === kind && !this.hides(part));
    this.kinds.forEach((kind, index) => kind.put(of(index), this.group, this.shadows, this.chosen, accent));
  }

  /** The part that an instance of a mesh is. */
  numberOf(mesh: InstancedMesh, index: number): number | undefined {
    return this.kinds.find((kind) => kind.mesh === mesh)?.numbers[index];
  }
}
