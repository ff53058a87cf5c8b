// The sealer: a belt, a housing about it, the bell that comes down on a tray, and the film on its reels.
// A belt of its own width on rollers, between rails on legs; parts lie at z = 0, a millimetre above it.
function belt(length, width, height) {
  const end = width / 2 + 0.012;
  const roller = [
    [0.006, -end], [0.006, -end + 0.01], [0.011, -end + 0.01], [0.011, -end + 0.012], [0.018, -end + 0.012],
    [0.02, -end + 0.016], [0.02, end - 0.016], [0.018, end - 0.012], [0.011, end - 0.012], [0.011, end - 0.01],
    [0.006, end - 0.01], [0.006, end],
  ];
  const lying = [-Math.PI / 2, 0, 0];
  const count = Math.round(length / 0.05);
  for (let i = 0; i < count; i += 1) {
    const x = (length * (i + 0.5)) / count;
    lathe({ profile: roller, segments: 42, at: [x, 0, -0.025], turn: lying, colour: [205, 209, 213], solid: false });
    if (i % 2 === 0) lathe({ profile: roller, segments: 42, at: [x, 0, -0.14], turn: lying, colour: [205, 209, 213], solid: false });
  }
  box({ size: [length, width, 0.003], at: [length / 2, 0, -0.0025], colour: [44, 48, 52] });
  box({ size: [length, width, 0.003], at: [length / 2, 0, -0.1165], colour: [44, 48, 52], solid: false });
  for (const side of [-1, 1]) {
    box({ size: [length, 0.02, 0.16], at: [length / 2, side * (width / 2 + 0.025), -0.085], colour: [176, 184, 190] });
    for (const x of [0.12, length - 0.12]) {
      box({ size: [0.05, 0.05, height - 0.185], at: [x, side * (width / 2 + 0.025), -0.165 - (height - 0.185) / 2], colour: [150, 156, 162] });
      lathe({
        profile: [[0.035, 0], [0.035, 0.008], [0.018, 0.018], [0.008, 0.02]], segments: 48,
        at: [x, side * (width / 2 + 0.025), -height], colour: [60, 60, 64],
      });
    }
  }
}

// A motor with its fins about x, at a place.
function motor(at, frame) {
  const profile = [[0.01, -0.02], [0.045, -0.02], [0.045, 0]];
  for (let fin = 0; fin < 12; fin += 1) profile.push([0.05, 0.004 + fin * 0.012], [0.05, 0.008 + fin * 0.012], [0.043, 0.009 + fin * 0.012], [0.043, 0.015 + fin * 0.012]);
  profile.push([0.045, 0.155], [0.02, 0.17]);
  lathe({ profile, segments: 64, at, turn: [0, Math.PI / 2, 0], colour: [45, 92, 140], frame });
}

function build({ length, width, travel }) {
  belt(length, width, 0.9);
  const at = 0.64;
  for (const side of [-1, 1]) {
    for (const x of [at - 0.35, at + 0.35]) box({ size: [0.05, 0.05, 0.75], at: [x, side * (width / 2 + 0.08), 0.375], colour: [228, 121, 36] });
    box({ size: [0.75, 0.03, 0.06], at: [at, side * (width / 2 + 0.08), 0.72], colour: [228, 121, 36] });
  }
  box({ size: [0.75, width + 0.2, 0.03], at: [at, 0, 0.765], colour: [228, 121, 36] });
  // The bell: four walls that go about the product and end on the tray's rim, 2 mm above it at full travel.
  const bell = frame('Slide', { at: [at, 0, 0.062 + travel], joint: { type: 'prismatic', axis: [0, 0, -1], min: 0, max: travel } });
  for (const side of [-1, 1]) {
    box({ size: [0.25, 0.015, 0.12], at: [0, side * 0.105, 0.06], frame: bell, colour: [205, 209, 213] });
    box({ size: [0.015, 0.195, 0.12], at: [side * 0.1325, 0, 0.06], frame: bell, colour: [205, 209, 213] });
  }
  box({ size: [0.28, 0.225, 0.02], at: [0, 0, 0.13], frame: bell, colour: [150, 156, 162] });
  cylinder({ radius: 0.025, height: 0.3, segments: 64, at: [0, 0, 0.14], frame: bell, colour: [205, 209, 213] });
  // Film: a full reel and an empty one, with their flanges.
  for (const [x, radius] of [[at - 0.25, 0.11], [at + 0.25, 0.05]]) {
    lathe({
      profile: [[0.02, -0.15], [0.13, -0.15], [0.13, -0.145], [radius, -0.145], [radius, 0.145], [0.13, 0.145], [0.13, 0.15], [0.02, 0.15]],
      segments: 96, at: [x, 0, 0.92], turn: [-Math.PI / 2, 0, 0], colour: [230, 230, 235],
    });
  }
  motor([at - 0.1, width / 2 + 0.16, 0.85]);
}
