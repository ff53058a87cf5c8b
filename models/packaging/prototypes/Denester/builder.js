// The denester: a stack of trays between guides over the conveyor, the elevator's motor, and the blades that part the stack.
// Its frame is beside the conveyor, x across it, 30 mm above the belt.
function build({ height }) {
  const [over, foot] = [0.35, 0.12];
  for (const dx of [-0.17, 0.17])
    for (const dy of [-0.19, 0.19]) box({ size: [0.03, 0.03, height], at: [over + dx, dy, foot + height / 2], colour: [176, 184, 190] });
  for (const dy of [-0.19, 0.19]) {
    box({ size: [0.37, 0.03, 0.03], at: [over, dy, foot + height + 0.015], colour: [176, 184, 190] });
    box({ size: [0.12, 0.05, foot + height + 0.9], at: [-0.06, dy, (foot + height - 0.9) / 2], colour: [150, 156, 162] });
    box({ size: [0.3, 0.03, 0.05], at: [0.05, dy, foot + 0.06], colour: [150, 156, 162] });
  }
  // Trays in one another, each a rim over a rounded tub.
  const round = (rx, ry, r) => {
    const outline = [];
    for (const [cx, cy, from] of [[rx - r, ry - r, 0], [r - rx, ry - r, 1], [r - rx, r - ry, 2], [rx - r, r - ry, 3]])
      for (let step = 0; step <= 8; step += 1) {
        const angle = ((from + step / 8) * Math.PI) / 2;
        outline.push([cx + r * Math.cos(angle), cy + r * Math.sin(angle)]);
      }
    return outline;
  };
  for (let tray = 0; tray < 24; tray += 1) {
    const z = foot + 0.08 + tray * 0.02;
    extrude({ outline: round(0.12, 0.15, 0.03), height: 0.003, at: [over, 0, z], colour: [235, 235, 240], solid: tray === 0 });
    extrude({ outline: round(0.11, 0.14, 0.03), height: 0.016, at: [over, 0, z - 0.016], colour: [220, 220, 228], solid: false });
  }
  const blades = frame('Slide', { at: [over, 0, foot + 0.05], joint: { type: 'prismatic', axis: [1, 0, 0], min: 0, max: 0.04 } });
  for (const dy of [-0.16, 0.16]) box({ size: [0.2, 0.02, 0.004], at: [0, dy, 0], frame: blades, colour: [205, 209, 213] });
  lathe({ profile: [[0.01, 0], [0.05, 0], [0.05, 0.16], [0.03, 0.18]], segments: 64, at: [-0.06, 0, foot + height - 0.2], colour: [45, 92, 140] });
}
