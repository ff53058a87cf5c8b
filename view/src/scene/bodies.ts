// The plant's bodies: every mesh once, drawn wherever it hangs.

import { type BufferGeometry, Color, DynamicDrawUsage, Group, InstancedMesh, Material, Matrix4, Quaternion, Vector3 } from "three";
import type { Shape } from "../api";

const ONE = new Vector3(1, 1, 1);

/** Where a body is drawn. */
interface Spot {
  mesh: InstancedMesh;
  index: number;
  local: Matrix4;
  colour: Color;
}

/** All bodies of a scene; a ghost has its own. */
export class Bodies {
  readonly group = new Group();
  readonly shadows = new Group();
  /** The frames' matrices, by their places. */
  readonly frames: Matrix4[];
  /** What hangs on each frame. */
  private readonly spots: Spot[][];
  /** The frame and the spot of each instance of each mesh. */
  private readonly owners = new Map<InstancedMesh, number[]>();
  private readonly scratch = new Matrix4();
  private readonly hidden: boolean[] = [];

  constructor(
    private readonly shape: Shape,
    geometries: BufferGeometry[],
    material: Material,
    shadow: Material | null,
  ) {
    this.frames = shape.nodes.map(() => new Matrix4());
    this.spots = shape.nodes.map(() => []);
    const wanted = new Map<number, number[]>();
    shape.bodies.forEach((body, index) => wanted.set(body.mesh, [...(wanted.get(body.mesh) ?? []), index]));
    for (const [mesh, bodies] of wanted) {
      const geometry = geometries[mesh];
      if (!geometry) continue;
      const drawn = new InstancedMesh(geometry, material, bodies.length);
      drawn.instanceMatrix.setUsage(DynamicDrawUsage);
      drawn.frustumCulled = false;
      const owners: number[] = [];
      bodies.forEach((place, index) => {
        const body = shape.bodies[place]!;
        const [x, y, z, qx, qy, qz, qw] = body.place;
        const local = new Matrix4().compose(new Vector3(x, y, z), new Quaternion(qx, qy, qz, qw), ONE);
        const colour = new Color().setRGB(body.colour[0] / 255, body.colour[1] / 255, body.colour[2] / 255, "srgb");
        this.spots[body.node]!.push({ mesh: drawn, index, local, colour });
        owners[index] = body.node;
        drawn.setColorAt(index, colour);
      });
      this.owners.set(drawn, owners);
      this.group.add(drawn);
      if (shadow) {
        const cast = new InstancedMesh(geometry, shadow, bodies.length);
        cast.instanceMatrix = drawn.instanceMatrix;
        cast.frustumCulled = false;
        // Nobody points at a shadow.
        cast.raycast = () => {};
        this.shadows.add(cast);
      }
    }
  }

  /** Moves frames to where a message has them. */
  move(nodes: Uint32Array, poses: Float32Array): void {
    const [place, turn] = [new Vector3(), new Quaternion()];
    for (let i = 0; i < nodes.length; i++) {
      const frame = this.frames[nodes[i]!];
      if (!frame) continue;
      place.fromArray(poses, i * 7);
      turn.fromArray(poses, i * 7 + 3);
      frame.compose(place, turn, ONE);
      this.hidden[nodes[i]!] = false;
      for (const { mesh, index, local } of this.spots[nodes[i]!]!) {
        mesh.setMatrixAt(index, this.scratch.multiplyMatrices(frame, local));
        mesh.instanceMatrix.needsUpdate = true;
        mesh.boundingSphere = null;
      }
    }
  }

  /** Hides what stands where `other` has it, and shows the rest: a ghost tells only what differs. */
  onlyUnlike(other: Bodies): void {
    this.frames.forEach((frame, node) => {
      const alike = frame.elements.every((number, index) => Math.abs(number - other.frames[node]!.elements[index]!) < 1e-3);
      if (alike === this.hidden[node]) return;
      this.hidden[node] = alike;
      for (const { mesh, index, local } of this.spots[node]!) {
        if (alike) this.scratch.makeScale(0, 0, 0);
        else this.scratch.multiplyMatrices(frame, local);
        mesh.setMatrixAt(index, this.scratch);
        mesh.instanceMatrix.needsUpdate = true;
      }
    });
  }

  /** The device that an instance of a mesh belongs to. */
  deviceOf(mesh: InstancedMesh, index: number): number | undefined {
    const node = this.owners.get(mesh)?.[index];
    return node === undefined ? undefined : this.shape.nodes[node]?.device;
  }

  /** Colours all bodies anew: `paint` gives another colour for a device, or none. */
  paint(paint: (device: number, own: Color) => Color | null): void {
    this.spots.forEach((spots, node) => {
      for (const { mesh, index, colour } of spots) {
        mesh.setColorAt(index, paint(this.shape.nodes[node]!.device, colour) ?? colour);
        if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
      }
    });
  }

  /** Shows every body of a device with its matrix in the world. */
  ofDevice(device: number, visit: (geometry: BufferGeometry, world: Matrix4) => void): void {
    this.spots.forEach((spots, node) => {
      if (this.shape.nodes[node]!.device !== device) return;
      for (const { mesh, local } of spots) visit(mesh.geometry, this.scratch.multiplyMatrices(this.frames[node]!, local));
    });
  }
}
