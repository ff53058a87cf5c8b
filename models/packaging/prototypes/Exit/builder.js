// The exit: a belt, and the bridge that its eye hangs on.
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

function build({ length, width }) {
  belt(length, width, 0.9);
  for (const side of [-1, 1]) box({ size: [0.04, 0.04, 0.5], at: [length / 2, side * (width / 2 + 0.06), 0.25], colour: [176, 184, 190] });
  box({ size: [0.04, width + 0.16, 0.04], at: [length / 2, 0, 0.52], colour: [176, 184, 190] });
  lathe({ profile: [[0.03, 0], [0.03, 0.05], [0.02, 0.06]], segments: 64, at: [length / 2, 0, 0.44], colour: [60, 60, 64] });
}
