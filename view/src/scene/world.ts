// The picture: camera, light, floor, the plant, its parts and beams, a ghost, what is chosen.

import {
  Box3,
  Box3Helper,
  BufferGeometry,
  CanvasTexture,
  Color,
  CylinderGeometry,
  Float32BufferAttribute,
  Group,
  InstancedMesh,
  LinearMipmapLinearFilter,
  LinearSRGBColorSpace,
  type LineBasicMaterial,
  LineSegments,
  type Matrix4,
  Mesh,
  MeshBasicMaterial,
  Object3D,
  OrthographicCamera,
  PerspectiveCamera,
  PlaneGeometry,
  Quaternion,
  Raycaster,
  Scene,
  type ShaderMaterial,
  Sprite,
  SpriteMaterial,
  Vector2,
  Vector3,
  WebGLRenderer,
  WebGLRenderTarget,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Plant } from "../api";
import type { Frame } from "../stream";
import { Bodies } from "./bodies";
import { dim, haze, shadow, surface } from "./light";
import { Parts } from "./parts";

Object3D.DEFAULT_UP.set(0, 0, 1);

/** What somebody points at. */
export type Picked = { device: string } | { part: number } | null;

const plain = (colour: string) => new Color().setStyle(colour, "srgb-linear");
const FREE = plain("#2fbf71");
const CUT = plain("#ff4d3d");

export class World {
  readonly canvas: HTMLCanvasElement;
  onpick: (picked: Picked) => void = () => {};
  /** Where the chosen device is on the canvas, CSS pixels; null where nothing is chosen or it is behind. */
  onlabel: (place: { x: number; y: number } | null) => void = () => {};
  readonly parts: Parts;
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(42, 1, 0.05, 400);
  private readonly orbit: OrbitControls;
  private readonly bodies: Bodies;
  private readonly ghost: Bodies | null = null;
  private readonly ghostParts: Parts | null = null;
  private readonly beams: Mesh<CylinderGeometry, ShaderMaterial>[];
  private readonly frame: Box3Helper;
  private readonly marks = new Group();
  private readonly bounds = new Box3();
  private readonly grid: LineSegments;
  /** Whether the computer draws without a graphics card: shadows are cast once then, and stay. */
  private readonly isSlow: boolean;
  private floor: Mesh<PlaneGeometry, MeshBasicMaterial> | null = null;
  private chosen: number | null = null;
  private stale = true;
  private settled = false;

  constructor(
    private readonly plant: Plant,
    geometries: BufferGeometry[],
  ) {
    this.renderer = new WebGLRenderer({ antialias: true, powerPreference: "high-performance" });
    // Colours are made for the screen where vertices are lit.
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    const gl = this.renderer.getContext();
    const about = gl.getExtension("WEBGL_debug_renderer_info");
    this.isSlow = /swiftshader|llvmpipe|software|basic render/i.test(String(about ? gl.getParameter(about.UNMASKED_RENDERER_WEBGL) : ""));
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", "The plant in three dimensions; the device list beside it names all devices");
    const cast = shadow();
    this.bodies = new Bodies(plant.scene, geometries, surface({ lit: true }), cast);
    this.parts = new Parts([plant.scene.parts.box, plant.scene.parts.pallet], surface({ lit: true, coloured: true }), cast);
    this.scene.add(this.bodies.shadows, this.bodies.group, this.parts.shadows, this.parts.group, this.marks);
    if (plant.ghost !== null) {
      const veil = surface({ tint: "#7c5cff", opacity: 0.26 });
      this.ghost = new Bodies(plant.scene, geometries, veil, null);
      this.ghost.paint(() => new Color("#ffffff"));
      this.ghostParts = new Parts([[255, 255, 255], [255, 255, 255]], veil, null);
      this.ghost.group.renderOrder = this.ghostParts.group.renderOrder = 2;
      this.scene.add(this.ghost.group, this.ghostParts.group);
    }
    this.beams = plant.scene.beams.map(() => {
      const beam = new Mesh(new CylinderGeometry(0.007, 0.007, 1, 6), surface({ tint: "#2fbf71", opacity: 0.9 }));
      beam.matrixAutoUpdate = false;
      this.scene.add(beam);
      return beam;
    });
    this.frame = new Box3Helper(new Box3(), new Color("#18a7b5"));
    this.frame.visible = false;
    this.scene.add(this.frame);

    this.grid = new LineSegments(tiles(), surface({ coloured: true }));
    this.scene.add(this.grid);

    this.orbit = new OrbitControls(this.camera, this.canvas);
    this.orbit.enableDamping = true;
    this.orbit.dampingFactor = 0.12;
    this.orbit.maxPolarAngle = Math.PI * 0.495;
    this.orbit.minDistance = 0.3;
    this.orbit.maxDistance = 120;
    this.orbit.addEventListener("change", () => (this.stale = true));
    this.theme();
    this.listen();
    new ResizeObserver(() => this.resize()).observe(this.canvas.parentElement ?? document.body);
    this.renderer.setAnimationLoop(() => this.turn());
  }

  /** Follows the page's light or dark. */
  theme(): void {
    const dark = document.documentElement.dataset["theme"] === "dark";
    const back = dark ? "#10161c" : "#e8edf1";
    this.scene.background = plain(back);
    dim(back, dark ? "#090d11" : "#ccd4db");
    if (this.floor) this.cast();
    const [line, centre] = dark ? ["#26313b", "#33414d"] : ["#cfd7de", "#b7c2cb"];
    const colours = this.grid.geometry.getAttribute("color");
    const [soft, strong] = [plain(line!), plain(centre!)];
    for (let i = 0; i < colours.count; i++) {
      const colour = this.grid.geometry.getAttribute("strong").getX(i) ? strong : soft;
      colours.setXYZ(i, colour.r, colour.g, colour.b);
    }
    colours.needsUpdate = true;
    this.stale = true;
  }

  take(frame: Frame): void {
    this.bodies.move(frame.plant.nodes, frame.plant.poses);
    this.parts.move(frame.begins, frame.plant.parts, frame.plant.gone);
    this.ghost?.move(frame.ghost.nodes, frame.ghost.poses);
    this.ghostParts?.move(frame.begins, frame.ghost.parts, frame.ghost.gone);
    this.ghost?.onlyUnlike(this.bodies);
    this.ghostParts?.onlyUnlike(this.parts);
    for (const { beam, cut } of frame.beams) (this.beams[beam]?.material.uniforms["tint"]?.value as Color | undefined)?.copy(cut ? CUT : FREE);
    if (frame.plant.nodes.length > 0) this.placeBeams(frame.begins ? null : frame.plant.nodes);
    if (frame.begins && !this.settled) {
      this.settled = true;
      this.bounds.copy(this.measure());
      this.settle();
      this.fit();
      if (this.isSlow) {
        this.bodies.shadows.visible = false;
        this.parts.shadows.visible = false;
        setTimeout(() => this.cast(), 1500);
      }
    }
    this.stale = true;
  }

  private placeBeams(moved: Uint32Array | null): void {
    const nodes = moved && new Set(moved);
    const [from, to] = [new Vector3(), new Vector3()];
    this.plant.scene.beams.forEach((mark, index) => {
      if (nodes && !nodes.has(mark.node)) return;
      const frame = this.bodies.frames[mark.node]!;
      from.fromArray(mark.ends[0]!).applyMatrix4(frame);
      to.fromArray(mark.ends[1]!).applyMatrix4(frame);
      const way = to.clone().sub(from);
      const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), way.clone().normalize());
      this.beams[index]!.matrix.compose(from.clone().addScaledVector(way, 0.5), turn, new Vector3(1, way.length(), 1));
      this.beams[index]!.matrixWorldNeedsUpdate = true;
    });
  }

  private measure(device?: number): Box3 {
    const whole = new Box3();
    const one = new Box3();
    this.plant.devices.forEach((_, index) => {
      if (device !== undefined && device !== index) return;
      this.bodies.ofDevice(index, (geometry, world) => {
        if (geometry.boundingBox) whole.union(one.copy(geometry.boundingBox).applyMatrix4(world));
      });
    });
    return whole;
  }

  /** Puts the floor under the plant. */
  private settle(): void {
    const [centre, size] = [this.bounds.getCenter(new Vector3()), this.bounds.getSize(new Vector3())];
    haze(Math.max(60, Math.max(size.x, size.y) * 4));
    this.grid.position.set(Math.round(centre.x), Math.round(centre.y), -0.002);
  }

  /** Casts the shadows of all devices as they stand now, for good. */
  private cast(): void {
    const [centre, size] = [this.bounds.getCenter(new Vector3()), this.bounds.getSize(new Vector3())];
    const [width, height] = [size.x + size.z * 1.6 + 1, size.y + size.z * 1.6 + 1];
    const target = new WebGLRenderTarget(1024, Math.round((1024 * height) / width), { generateMipmaps: true, minFilter: LinearMipmapLinearFilter });
    const above = new OrthographicCamera(-width / 2, width / 2, height / 2, -height / 2, 0.1, 50);
    above.up.set(0, 1, 0);
    above.position.set(centre.x + size.z * 0.3, centre.y + size.z * 0.3, 10);
    above.lookAt(above.position.x, above.position.y, 0);
    const shown = this.scene.children.map((child) => child.visible);
    this.scene.children.forEach((child) => (child.visible = child === this.bodies.shadows));
    this.renderer.setRenderTarget(target);
    this.renderer.render(this.scene, above);
    this.renderer.setRenderTarget(null);
    this.scene.children.forEach((child, index) => (child.visible = shown[index] ?? true));
    if (this.floor) this.scene.remove(this.floor);
    this.floor?.material.map?.dispose();
    this.floor = new Mesh(new PlaneGeometry(width, height), new MeshBasicMaterial({ map: target.texture }));
    this.floor.position.set(above.position.x, above.position.y, -0.004);
    this.floor.renderOrder = -1;
    this.scene.add(this.floor);
    this.stale = true;
  }

  /** Shows all of the plant, or one device. */
  fit(device?: string): void {
    const index = this.plant.devices.findIndex((other) => other.name === device);
    const box = index >= 0 ? this.measure(index) : this.measure();
    if (box.isEmpty()) return;
    const way = index >= 0 ? this.camera.position.clone().sub(this.orbit.target).normalize() : new Vector3(-0.34, -1, 0.8).normalize();
    const boxes = index >= 0 ? [box] : this.plant.devices.map((_, device) => this.measure(device)).filter((one) => !one.isEmpty());
    const { target, distance } = this.frameFor(boxes, way, index >= 0 ? 0.5 : 0.92);
    this.orbit.target.copy(target);
    this.camera.position.copy(target).addScaledVector(way, distance);
    this.orbit.update();
    this.stale = true;
  }

  /** Where to look and from how far, along `way`, so that the boxes fill `share` of the picture. */
  private frameFor(boxes: Box3[], way: Vector3, share: number): { target: Vector3; distance: number } {
    const right = new Vector3().crossVectors(new Vector3(0, 0, 1), way).normalize();
    const up = new Vector3().crossVectors(way, right);
    const tall = Math.tan((this.camera.fov / 360) * Math.PI) * share;
    const wide = tall * this.camera.aspect;
    const corner = (box: Box3, i: number) => new Vector3(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z);
    const corners = boxes.flatMap((box) => Array.from({ length: 8 }, (_, i) => corner(box, i)));
    const whole = boxes.reduce((all, box) => all.union(box), new Box3());
    const target = whole.getCenter(new Vector3());
    let distance = whole.getSize(new Vector3()).length() + 0.8;
    for (let round = 0; round < 8; round++) {
      const [low, high] = [new Vector2(Infinity, Infinity), new Vector2(-Infinity, -Infinity)];
      for (const place of corners) {
        const arm = place.clone().sub(target);
        const depth = Math.max(0.1, distance - arm.dot(way));
        const seen = new Vector2(arm.dot(right) / (depth * wide), arm.dot(up) / (depth * tall));
        low.min(seen);
        high.max(seen);
      }
      target.addScaledVector(right, ((low.x + high.x) / 2) * wide * distance).addScaledVector(up, ((low.y + high.y) / 2) * tall * distance);
      distance *= Math.max((high.x - low.x) / 2, (high.y - low.y) / 2);
    }
    return { target, distance: Math.max(distance, 0.8) };
  }

  /** Looks at a place. */
  lookAt(place: [number, number, number]): void {
    const way = this.camera.position.clone().sub(this.orbit.target).setLength(3.5);
    this.orbit.target.fromArray(place);
    this.camera.position.copy(this.orbit.target).add(way);
    this.orbit.update();
  }

  /** Turns, lifts and nears the camera: for the keyboard. */
  nudge(turn: number, lift: number, near: number): void {
    const arm = this.camera.position.clone().sub(this.orbit.target);
    const length = arm.length() * near;
    const yaw = Math.atan2(arm.y, arm.x) + turn;
    const pitch = Math.min(1.5, Math.max(0.02, Math.asin(arm.z / arm.length()) + lift));
    arm.set(Math.cos(yaw) * Math.cos(pitch), Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch)).multiplyScalar(length);
    this.camera.position.copy(this.orbit.target).add(arm);
    this.orbit.update();
    this.stale = true;
  }

  choose(device: string | null, part: number | null): void {
    const index = this.plant.devices.findIndex((other) => other.name === device);
    this.chosen = index < 0 ? null : index;
    this.parts.choose(part);
    this.stale = true;
  }

  /** Colours the devices by their shares of a gap; null takes the colours away. */
  heat(shares: Map<string, number> | null): void {
    const [cool, hot] = [new Color("#9aa5ae"), new Color("#e5322d")];
    const warm = new Color("#f6b73c");
    const greatest = Math.max(...(shares?.values() ?? [1]), 1e-9);
    this.bodies.paint((device, own) => {
      if (!shares) return null;
      const share = shares.get(this.plant.devices[device]!.name) ?? 0;
      const grey = own.clone().lerp(cool, 0.8);
      if (share <= 0) return grey;
      const heat = share / greatest;
      return heat < 0.5 ? grey.lerp(warm, 0.35 + heat * 1.3) : warm.clone().lerp(hot, (heat - 0.5) * 2);
    });
    this.stale = true;
  }

  /** Marks a place in red for some seconds. */
  mark(place: [number, number, number]): void {
    const sprite = new Sprite(new SpriteMaterial({ map: ring(), depthTest: false, transparent: true }));
    sprite.position.fromArray(place);
    sprite.scale.setScalar(0.55);
    sprite.renderOrder = 5;
    this.marks.add(sprite);
    this.stale = true;
    setTimeout(() => {
      this.marks.remove(sprite);
      this.stale = true;
    }, 12_000);
  }

  private listen(): void {
    let [x, y] = [0, 0];
    this.canvas.addEventListener("pointerdown", (event) => ([x, y] = [event.clientX, event.clientY]));
    this.canvas.addEventListener("pointerup", (event) => {
      if (event.button === 0 && Math.hypot(event.clientX - x, event.clientY - y) < 5) this.pick(event);
    });
    this.canvas.addEventListener("dblclick", (event) => {
      const picked = this.at(event);
      if (picked && "device" in picked) this.fit(picked.device);
    });
  }

  private pick(event: PointerEvent): void {
    this.onpick(this.at(event));
  }

  /** What is at a place of the canvas. */
  private at(event: MouseEvent): Picked {
    const box = this.canvas.getBoundingClientRect();
    const place = new Vector2(((event.clientX - box.left) / box.width) * 2 - 1, 1 - ((event.clientY - box.top) / box.height) * 2);
    const ray = new Raycaster();
    ray.setFromCamera(place, this.camera);
    for (const hit of ray.intersectObjects([this.bodies.group, this.parts.group], true)) {
      if (!(hit.object instanceof InstancedMesh) || hit.instanceId === undefined) continue;
      const part = this.parts.numberOf(hit.object, hit.instanceId);
      if (part !== undefined) return { part };
      const device = this.bodies.deviceOf(hit.object, hit.instanceId);
      if (device !== undefined) return { device: this.plant.devices[device]!.name };
    }
    return null;
  }

  /** Where a device is on the page, for those who point at it. */
  placeOf(device: string): { x: number; y: number } | null {
    const index = this.plant.devices.findIndex((other) => other.name === device);
    const box = this.measure(index);
    return index < 0 || box.isEmpty() ? null : this.project(box.getCenter(new Vector3()));
  }

  private project(place: Vector3): { x: number; y: number } | null {
    const seen = place.project(this.camera);
    const box = this.canvas.getBoundingClientRect();
    if (seen.z > 1) return null;
    return { x: ((seen.x + 1) / 2) * box.width, y: ((1 - seen.y) / 2) * box.height };
  }

  private resize(): void {
    const place = this.canvas.parentElement;
    if (!place || place.clientWidth === 0 || place.clientHeight === 0) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.renderer.setSize(place.clientWidth, place.clientHeight);
    this.camera.aspect = place.clientWidth / place.clientHeight;
    this.camera.updateProjectionMatrix();
    this.stale = true;
  }

  private turn(): void {
    this.orbit.update();
    // Before the plant stands there is nothing to see, and drawing its meshes costs all the same.
    if (!this.stale || !this.settled) return;
    this.stale = false;
    if (this.chosen !== null) {
      const box = this.measure(this.chosen);
      this.frame.box.copy(box.expandByScalar(0.02));
      (this.frame.material as LineBasicMaterial).depthTest = false;
    }
    this.frame.visible = this.chosen !== null && !this.frame.box.isEmpty();
    this.renderer.render(this.scene, this.camera);
    const top = this.frame.box.getCenter(new Vector3()).setZ(this.frame.box.max.z);
    this.onlabel(this.frame.visible ? this.project(top) : null);
    document.documentElement.dataset["pictures"] = String(Number(document.documentElement.dataset["pictures"] ?? 0) + 1);
  }

  /** The matrix of a frame, for those who test. */
  frameOf(name: string): Matrix4 | undefined {
    return this.bodies.frames[this.plant.scene.nodes.findIndex((node) => node.name === name)];
  }
}

/** The floor's lines, a metre apart, each tenth stronger; in pieces, so that each fades where it is. */
function tiles(): BufferGeometry {
  const [reach, piece] = [45, 3];
  const [places, strong]: [number[], number[]] = [[], []];
  for (let line = -reach; line <= reach; line++)
    for (let at = -reach; at < reach; at += piece) {
      places.push(line, at, 0, line, at + piece, 0, at, line, 0, at + piece, line, 0);
      for (let i = 0; i < 4; i++) strong.push(line % 10 === 0 ? 1 : 0);
    }
  const lines = new BufferGeometry();
  lines.setAttribute("position", new Float32BufferAttribute(places, 3));
  lines.setAttribute("strong", new Float32BufferAttribute(strong, 1));
  lines.setAttribute("color", new Float32BufferAttribute(places.map(() => 0), 3));
  return lines;
}

/** A red ring with a cross in it. */
function ring(): CanvasTexture {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 128;
  const pen = canvas.getContext("2d");
  if (pen) {
    pen.lineWidth = 12;
    pen.strokeStyle = "#ff3b30";
    pen.fillStyle = "rgba(255,59,48,.25)";
    pen.beginPath();
    pen.arc(64, 64, 52, 0, Math.PI * 2);
    pen.fill();
    pen.stroke();
    pen.moveTo(44, 44);
    pen.lineTo(84, 84);
    pen.moveTo(84, 44);
    pen.lineTo(44, 84);
    pen.stroke();
  }
  return new CanvasTexture(canvas);
}
