// The pictures: one canvas a side, the ready-made picture at once and the exact one as soon as it is unpacked.

const byId = (id) => document.getElementById(id);
const sides = [0, 1].map((side) => ({
  figure: byId("side" + side),
  canvas: byId("canvas" + side),
  caption: byId("caption" + side),
  turn: 0, // counts what was asked for, so that what comes late is not shown
  shown: null, // parts of the picture that is shown exactly
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
async function plateOf(frame) {
  const { plate } = data.tone;
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
  place.figure.hidden = state.sides[side] === null;
  if (place.figure.hidden || !frames(side).length) return;
  const frame = shot(side);
  const canvas = place.canvas;
  caption(side, frame);
  const late = () => turn !== place.turn;
  if (!frame.layers || isPlain()) {
    const image = await readyMade(frame);
    if (late()) return;
    sized(canvas, frame).drawImage(image, 0, 0);
    place.shown = null;
    canvas.dataset.shown = "ready-made";
  }
  if (!frame.layers) return;
  const [parts, plate] = await Promise.all([partsOf(frame), plateOf(frame)]);
  if (late()) return;
  const picture = develop(parts, effective(), data.tone, state.stops, plate);
  sized(canvas, frame).putImageData(picture, 0, 0);
  place.shown = parts;
  canvas.dataset.shown = "exact";
}

function caption(side, frame) {
  const variant = data.variants[state.sides[side]];
  const pass = state.pass === null ? "" : data.passes[state.pass];
  const facts = frame.facts.map(([, value]) => value);
  const missing = (state.pass !== null || state.stops !== 0) && !frame.layers ? "no passes kept for this frame" : "";
  const words = [variant.id, "frame " + frame.number, ...facts, pass, missing];
  sides[side].caption.textContent = words.filter(Boolean).join("  \u00b7  ");
  const named = `${pass || "beauty"}, frame ${frame.number} of ${frames(side).length}`;
  sides[side].canvas.setAttribute("aria-label", variant.id ? `${variant.id}: ${named}` : named);
}

// Linear values under the pointer.
function readout(side, event) {
  const { canvas, shown } = sides[side];
  const box = canvas.getBoundingClientRect();
  const x = Math.floor(((event.clientX - box.left) / box.width) * canvas.width);
  const y = Math.floor(((event.clientY - box.top) / box.height) * canvas.height);
  if (!shown || x < 0 || y < 0 || x >= canvas.width || y >= canvas.height) return "";
  const sum = [0, 0, 0];
  light(shown, effective(), y * canvas.width + x, sum);
  const alpha = coverage(shown.alpha, y * canvas.width + x);
  const [r, g, b, a] = [...sum, alpha].map((v) => v.toPrecision(3));
  return `${x}, ${y}   R ${r}  G ${g}  B ${b}  A ${a}  (linear)`;
}
