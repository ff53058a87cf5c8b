// The binary stream: what moved and what changed since the last message. Its form stands in src/view/frame.rs.

export interface PartMove {
  number: number;
  kind: number;
  /** Length, width, height, m. */
  size: [number, number, number];
  /** The centre of its bottom face, m, and its turn about z, rad. */
  place: [number, number, number, number];
}
export interface Standing {
  /** Places in the scene, and seven numbers for each: position and quaternion. */
  nodes: Uint32Array;
  poses: Float32Array;
  parts: PartMove[];
  gone: number[];
}
export interface Frame {
  begins: boolean;
  run: number;
  at: number;
  speed: number;
  plant: Standing;
  ghost: Standing;
  values: { register: number; value: number }[];
  beams: { beam: number; cut: boolean }[];
}

class Cursor {
  private at = 0;
  private readonly view: DataView;
  constructor(buffer: ArrayBuffer) {
    this.view = new DataView(buffer);
  }
  u8 = () => this.view.getUint8(this.at++);
  u32 = () => this.view.getUint32((this.at += 4) - 4, true);
  f32 = () => this.view.getFloat32((this.at += 4) - 4, true);
  f64 = () => this.view.getFloat64((this.at += 8) - 8, true);
  skip = (bytes: number) => void (this.at += bytes);
  list<T>(read: () => T): T[] {
    const length = this.u32();
    return Array.from({ length }, read);
  }
  poses(): Pick<Standing, "nodes" | "poses"> {
    const count = this.u32();
    const [nodes, poses] = [new Uint32Array(count), new Float32Array(count * 7)];
    for (let i = 0; i < count; i++) {
      nodes[i] = this.u32();
      for (let j = 0; j < 7; j++) poses[i * 7 + j] = this.f32();
    }
    return { nodes, poses };
  }
  parts(): Pick<Standing, "parts" | "gone"> {
    const parts = this.list<PartMove>(() => ({
      number: this.u32(),
      kind: this.u32(),
      size: [this.f32(), this.f32(), this.f32()],
      place: [this.f32(), this.f32(), this.f32(), this.f32()],
    }));
    return { parts, gone: this.list(this.u32) };
  }
}

/** Reads one message; null for one of another kind. */
export function decode(buffer: ArrayBuffer): Frame | null {
  const cursor = new Cursor(buffer);
  if (cursor.u8() !== 1) return null;
  const begins = cursor.u8() === 1;
  cursor.skip(2);
  const [run, at, speed] = [cursor.u32(), cursor.f64(), cursor.f64()];
  const plant = { ...cursor.poses(), ...cursor.parts() };
  const values = cursor.list(() => ({ register: cursor.u32(), value: cursor.f64() }));
  const beams = cursor.list(() => ({ beam: cursor.u32(), cut: cursor.u32() === 1 }));
  const ghost = { ...cursor.poses(), ...cursor.parts() };
  return { begins, run, at, speed, plant, ghost, values, beams };
}

/** Follows the stream, and takes it up again where it breaks off. */
export function follow(onframe: (frame: Frame) => void, onlink: (connected: boolean) => void): void {
  let wait = 250;
  const dial = () => {
    const socket = new WebSocket(`ws://${location.host}/api/stream`);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      wait = 250;
      onlink(true);
    };
    socket.onmessage = (message: MessageEvent<ArrayBuffer>) => {
      const frame = decode(message.data);
      if (frame) onframe(frame);
    };
    socket.onclose = () => {
      onlink(false);
      setTimeout(dial, wait);
      wait = Math.min(wait * 2, 4000);
    };
  };
  dial();
}
