// The pictures: one canvas a side, the ready-made picture at once and the exact one as soon as it is unpacked. Where
// both are put into one, each has a canvas apart from the page.

const byId = (id) => document.getElementById(id);
const sides = [0, 1].map((side) => ({
  figure: byId("side" + side),
  canvas: byId("canvas" + side),
  caption: byId("caption" + side),
  apart: document.createElement("canvas"),
  turn: 0, // counts what was asked for, so that what comes late is not shown
  drawn: 0, // what was last drawn of it
  shown: null, // parts of the picture that is shown exactly
  label: "", // what it shows, in words
}));

// Frames unpacked lately.
const unpacked = new Map();
const MOST_UNPACKED = 10;

function partsOf(frame) {
  let parts = unpacked.get(frame);
  unpacked.delete(frame);
  parts ??= unpack(frame);
  unpacked.set(frame, parts);
  if (unpacked.size > MOST_UNPACKED) unpacked.delete(unpacked.keys().next().value);
  return parts;
}

// Ready-made pictures, decoded once.
const made = new Map();
function readyMade(frame) {
  if (!made.has(frame)) {
    const image = new Image();
    image.src = "data:image/jpeg;base64," + frame.jpeg;
    made.set(frame, image.decode().then(() => image));
  }
  return made.get(frame);
}

const plates = new Map();
async function plateOf(tone, frame) {
  const { plate } = tone;
  if (!plate || plate.width !== frame.width || plate.height !== frame.height) return null;
  if (!plates.has(plate)) {
    plates.set(plate, pixelsOf(plate.png).then((bytes) => {
      const linear = new Float32Array(3 * frame.width * frame.height);
      for (let i = 0; i < linear.length; i++) linear[i] = fromByte(bytes[4 * Math.floor(i / 3) + (i % 3)]);
      return linear;
    }));
  }
  return plates.get(plate);
}

function sized(canvas, frame) {
  if (canvas.width !== frame.width || canvas.height !== frame.height) {
    canvas.width = frame.width;
    canvas.height = frame.height;
    canvas.style.setProperty("--wide", frame.width);
    canvas.style.setProperty("--high", frame.height);
  }
  return canvas.getContext("2d", { willReadFrequently: true });
}

async function draw(side) {
  const place = sides[side];
  const turn = ++place.turn;
  place.figure.hidden = state.sides[side] === null || (side === 1 && together());
  if (state.sides[side] === null || !frames(side).length) return;
  const frame = shot(side);
  const canvas = together() ? place.apart : place.canvas;
  caption(side, frame);
  const late = () => turn !== place.turn;
  const drawn = (parts) => {
    place.shown = parts;
    place.drawn = turn;
    canvas.dataset.shown = parts ? "exact" : "ready-made";
    combine();
  };
  if (!frame.layers || isPlain(side)) {
    const image = await readyMade(frame);
    if (late()) return;
    sized(canvas, frame).drawImage(image, 0, 0);
    drawn(null);
  }
  if (!frame.layers) return;
  const tone = data.tones[data.variants[state.sides[side]].tone];
  const weights = effective(side);
  const [parts, plate] = await Promise.all([partsOf(frame), plateOf(tone, frame)]);
  if (late()) return;
  const picture = develop(parts, weights, tone, state.stops, plate);
  sized(canvas, frame).putImageData(picture, 0, 0);
  drawn(parts);
}

function caption(side, frame) {
  const place = sides[side];
  const variant = data.variants[state.sides[side]];
  const pass = state.pass === null ? "" : data.passes[state.pass];
  const facts = frame.facts.map(([, value]) => value);
  const missing = !frame.layers && !isPlain(side) ? "no passes kept for this frame" : "";
  const words = [variant.id, "frame " + frame.number, ...facts, pass, missing];
  place.caption.textContent = words.filter(Boolean).join("  \u00b7  ");
  const named = `${pass || "beauty"}, frame ${frame.number} of ${frames(side).length}`;
  place.label = variant.id ? `${variant.id}: ${named}` : named;
  place.canvas.setAttribute("aria-label", place.label);
}

// Linear values under the pointer.
function readout(side, event) {
  const box = sides[side].canvas.getBoundingClientRect();
  const [across, down] = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
  const of = together() && state.view === "wipe" && across >= state.cut ? 1 : side;
  const { shown } = sides[of];
  if (!shown || across < 0 || down < 0 || across >= 1 || down >= 1) return "";
  const [x, y] = [Math.floor(across * shown.width), Math.floor(down * shown.height)];
  const sum = [0, 0, 0];
  light(shown, effective(of), y * shown.width + x, sum);
  const alpha = coverage(shown.alpha, y * shown.width + x);
  const [r, g, b, a] = [...sum, alpha].map((v) => v.toPrecision(3));
  return `${x}, ${y}   R ${r}  G ${g}  B ${b}  A ${a}  (linear)`;
}
