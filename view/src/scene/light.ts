// How surfaces are lit: at their vertices, by a sky, a sun and a fill, with their shadows cast flat onto the floor.
//
// One small shader for everything: it is compiled at once, and costs a computer without a graphics card next to nothing.

import { Color, DoubleSide, ShaderMaterial, Vector3 } from "three";

/** Where the sun is seen from the plant. */
export const SUN = new Vector3(-0.42, -0.58, 1.15).normalize();

const shared = {
  sun: { value: SUN },
  fog: { value: new Color() },
  floor: { value: new Color() },
  far: { value: 60 },
};

/** Follows the page's light or dark: colours as they stand on the screen. */
export function dim(back: string, shadow: string): void {
  const plain = (colour: string) => new Color().setStyle(colour, "srgb-linear");
  shared.fog.value.copy(plain(back));
  shared.floor.value.copy(plain(shadow));
}

/** How far it is to where nothing is seen any more, m. */
export function haze(far: number): void {
  shared.far.value = far;
}

const VERTEX = /* glsl */ `
  uniform vec3 sun; uniform vec3 fog; uniform float far; uniform vec3 tint;
  varying vec3 shade;
  void main() {
    #ifdef USE_INSTANCING
      mat4 place = modelMatrix * instanceMatrix;
    #else
      mat4 place = modelMatrix;
    #endif
    vec4 world = place * vec4(position, 1.0);
    vec4 eye = viewMatrix * world;
    gl_Position = projectionMatrix * eye;
    vec3 colour = tint;
    #ifdef USE_INSTANCING_COLOR
      colour *= instanceColor;
    #endif
    #ifdef USE_COLOR
      colour *= color;
    #endif
    #ifdef LIT
      vec3 n = normalize(mat3(place) * normal);
      float low = mix(0.72, 1.0, smoothstep(-0.05, 0.85, world.z));
      vec3 light = mix(vec3(0.40, 0.41, 0.44), vec3(0.80, 0.84, 0.90), 0.5 + 0.5 * n.z) * low;
      light += vec3(0.80, 0.75, 0.66) * max(dot(n, sun), 0.0);
      light += vec3(0.10, 0.13, 0.17) * max(dot(n, vec3(0.75, 0.62, 0.2)), 0.0);
      colour *= light;
      colour = colour / (0.82 + 0.28 * colour);
      colour = pow(clamp(colour, 0.0, 1.0), vec3(1.0 / 2.2));
    #endif
    shade = mix(colour, fog, smoothstep(0.45 * far, far, -eye.z));
  }`;

const FRAGMENT = /* glsl */ `
  uniform float opacity; varying vec3 shade;
  void main() { gl_FragColor = vec4(shade, opacity); }`;

const SHADOW = /* glsl */ `
  uniform vec3 sun; uniform vec3 fog; uniform vec3 floor; uniform float far;
  varying vec3 shade;
  void main() {
    vec4 world = modelMatrix * instanceMatrix * vec4(position, 1.0);
    world.xy -= sun.xy * (world.z / sun.z);
    world.z = 0.004;
    vec4 eye = viewMatrix * world;
    gl_Position = projectionMatrix * eye;
    shade = mix(floor, fog, smoothstep(0.45 * far, far, -eye.z));
  }`;

/** What something is drawn with: lit, or in its plain colour. */
export function surface(more: { lit?: boolean; tint?: string; opacity?: number; coloured?: boolean }): ShaderMaterial {
  const opacity = more.opacity ?? 1;
  const tint = new Color();
  if (more.tint) more.lit ? tint.setStyle(more.tint) : tint.setStyle(more.tint, "srgb-linear");
  else tint.setScalar(1);
  return new ShaderMaterial({
    vertexShader: VERTEX,
    fragmentShader: FRAGMENT,
    uniforms: { ...shared, tint: { value: tint }, opacity: { value: opacity } },
    defines: more.lit ? { LIT: "" } : {},
    vertexColors: more.coloured ?? false,
    transparent: opacity < 1,
    depthWrite: opacity === 1,
  });
}

/** What shadows on the floor are drawn with. */
export function shadow(): ShaderMaterial {
  return new ShaderMaterial({
    vertexShader: SHADOW,
    fragmentShader: FRAGMENT,
    uniforms: { ...shared, opacity: { value: 1 } },
    side: DoubleSide,
    polygonOffset: true,
    polygonOffsetFactor: 0,
    polygonOffsetUnits: 0,
  });
}
