// What a builder may call. Lengths are metres, angles radians; z points up in the frame of the instance.
"use strict";
const __made = { frames: [], bodies: [] };
const __defaults = { at: [0, 0, 0], turn: [0, 0, 0], colour: [160, 164, 168], solid: true };

function __fail(what) { throw new TypeError(what); }

function __number(value, what) {
  return typeof value === "number" && Number.isFinite(value) ? value : __fail(`${what} is ${value}: expected a finite number`);
}

function __above(value, what) {
  return __number(value, what) > 0 ? value : __fail(`${what} is ${value}: expected more than 0`);
}

function __numbers(value, count, what) {
  if (!Array.isArray(value) || value.length !== count) __fail(`${what} is ${JSON.stringify(value)}: expected ${count} numbers`);
  return value.map(number => __number(number, what));
}

function __pairs(value, least, what) {
  if (!Array.isArray(value) || value.length < least) __fail(`${what}: expected at least ${least} pairs of numbers`);
  return value.map(pair => __numbers(pair, 2, what));
}

function __segments(value) {
  return Number.isInteger(value) && value >= 3 && value <= 512 ? value : __fail(`segments is ${value}: expected 3 to 512`);
}

function __options(options, known, what) {
  for (const name of Object.keys(options))
    if (!known.includes(name)) __fail(`${what} has no option ${name}: expected ${known.join(", ")}`);
  return options;
}

function __body(options, known, form) {
  const given = { ...__defaults, ...__options(options, [...known, "at", "turn", "colour", "solid", "frame"], form.kind) };
  const colour = __numbers(given.colour, 3, "colour");
  if (!colour.every(c => Number.isInteger(c) && c >= 0 && c <= 255)) __fail(`colour is ${colour}: expected 0 to 255`);
  if (given.frame !== undefined && !__made.frames.some(frame => frame.name === given.frame))
    __fail(`there is no frame ${given.frame}: expected one that frame() has made before`);
  __made.bodies.push({
    frame: given.frame ?? null, at: __numbers(given.at, 3, "at"), turn: __numbers(given.turn, 3, "turn"), colour,
    solid: Boolean(given.solid), form,
  });
}

function frame(name, options = {}) {
  const given = { at: [0, 0, 0], turn: [0, 0, 0], ...__options(options, ["parent", "at", "turn", "joint"], "frame") };
  if (typeof name !== "string" || !/^[A-Za-z_][A-Za-z0-9_]*$/.test(name))
    __fail(`${JSON.stringify(name)} is no identifier: expected letters, digits and _, no digit first`);
  if (__made.frames.some(known => known.name === name)) __fail(`two frames are called ${name}: expected each name once`);
  if (given.parent !== undefined && !__made.frames.some(known => known.name === given.parent))
    __fail(`there is no frame ${given.parent}: expected one that frame() has made before`);
  let joint = null;
  if (given.joint !== undefined) {
    const { type, axis, min, max, zero } = __options(given.joint, ["type", "axis", "min", "max", "zero"], "joint");
    if (type !== "prismatic" && type !== "revolute") __fail(`the joint's type is ${type}: expected prismatic or revolute`);
    if (axis === undefined) __fail("a joint without an axis: expected axis: [x, y, z]");
    if (__numbers(axis, 3, "axis").every(number => number === 0)) __fail("axis is 0,0,0: expected three numbers, not all 0");
    const limit = (value, what) => (value === undefined ? null : __number(value, what));
    joint = { type, axis, min: limit(min, "min"), max: limit(max, "max"), zero: zero === undefined ? 0 : __number(zero, "zero") };
    if (joint.min !== null && joint.max !== null && joint.min > joint.max) __fail(`min is ${min}: expected not above max, ${max}`);
  }
  __made.frames.push({
    name, parent: given.parent ?? null, at: __numbers(given.at, 3, "at"), turn: __numbers(given.turn, 3, "turn"), joint,
  });
  return name;
}

function box(options) {
  const size = __numbers(options.size, 3, "size").map(side => __above(side, "size"));
  __body(options, ["size"], { kind: "box", size });
}

function cylinder(options) {
  const [radius, height] = [__above(options.radius, "radius"), __above(options.height, "height")];
  __body(options, ["radius", "height", "segments"], { kind: "lathe", profile: [[radius, 0], [radius, height]], segments: __segments(options.segments ?? 32) });
}

function lathe(options) {
  const profile = __pairs(options.profile, 2, "profile");
  if (profile.some(([radius]) => radius < 0)) __fail("profile has a radius below 0: expected [radius, height] pairs");
  __body(options, ["profile", "segments"], { kind: "lathe", profile, segments: __segments(options.segments ?? 32) });
}

function extrude(options) {
  __body(options, ["outline", "height"], {
    kind: "extrude", outline: __pairs(options.outline, 3, "outline"), height: __above(options.height, "height"),
  });
}

function mesh(options) {
  const { file, unit, up, simplify } = options;
  if (typeof file !== "string") __fail(`file is ${file}: expected the name of a mesh's file`);
  __body(options, ["file", "unit", "up", "simplify"], {
    kind: "mesh", file, unit: unit ?? null, up: up ?? null, simplify: simplify === undefined ? 0 : __number(simplify, "simplify"),
  });
}

function __run(parameters) {
  if (typeof build !== "function") __fail("there is no function build: expected function build(parameters)");
  build(parameters);
  return __made;
}

function __customize(parameters) {
  if (typeof customize !== "function") __fail("there is no function customize: expected function customize(parameters)");
  return customize(parameters) ?? {};
}
