// From packed layers to pixels, in linear light.

// A value is scale * (byte / 255)^2; the scale, a power of two, is the pixel's own.
const SQUARES = Float64Array.from({ length: 256 }, (_, m) => (m / 255) * (m / 255));
const SCALES = Float64Array.from({ length: 256 }, (_, e) => (e === 0 ? 0 : 2 ** (e - 128)));

// IEC 61966-2-1 in bytes, finer than a byte can tell.
const SRGB = Uint8Array.from({ length: 65536 }, (_, i) => {
  const v = i / 65535;
  return Math.floor(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055) + 0.5);
});
const toByte = (v) => (v <= 0 ? 0 : v >= 1 ? 255 : SRGB[Math.floor(v * 65535 + 0.5)]);
const fromByte = (b) => (b / 255 <= 0.04045 ? b / 255 / 12.92 : ((b / 255 + 0.055) / 1.055) ** 2.4);

async function pixelsOf(base64) {
  const image = new Image();
  image.src = "data:image/png;base64," + base64;
  await image.decode();
  const canvas = document.createElement("canvas");
  canvas.width = image.naturalWidth;
  canvas.height = image.naturalHeight;
  const context = canvas.getContext("2d", { willReadFrequently: true });
  context.drawImage(image, 0, 0);
  return context.getImageData(0, 0, canvas.width, canvas.height).data;
}

// Everything a frame is made of, unpacked as far as it pays.
async function unpack(frame) {
  const layers = await Promise.all(frame.layers.map((layer) => (layer ? pixelsOf(layer) : null)));
  const alpha = frame.alpha ? await pixelsOf(frame.alpha) : null;
  return { width: frame.width, height: frame.height, layers, alpha };
}

// Coverage of pixel i: sixteen bits, the high byte red and the low one green.
const coverage = (alpha, i) => (alpha ? (alpha[4 * i] * 256 + alpha[4 * i + 1]) / 65535 : 1);

// Adds up the layers of pixel i into `sum`.
function light(parts, weights, i, sum) {
  sum[0] = sum[1] = sum[2] = 0;
  const count = parts.width * parts.height;
  const third = Math.floor(i / 3);
  const scaleAt = 4 * (count + third) + (i - 3 * third);
  for (let layer = 0; layer < parts.layers.length; layer++) {
    const bytes = parts.layers[layer];
    if (!bytes || weights[layer] === 0) continue;
    const scale = SCALES[bytes[scaleAt]] * weights[layer];
    if (scale === 0) continue;
    sum[0] += scale * SQUARES[bytes[4 * i]];
    sum[1] += scale * SQUARES[bytes[4 * i + 1]];
    sum[2] += scale * SQUARES[bytes[4 * i + 2]];
  }
}

// Khronos PBR Neutral, as in the PNGs.
function neutral(c) {
  const start = 0.8 - 0.04;
  const least = Math.min(c[0], c[1], c[2]);
  const off = least < 0.08 ? least - 6.25 * least * least : 0.04;
  c[0] -= off; c[1] -= off; c[2] -= off;
  const peak = Math.max(c[0], c[1], c[2]);
  if (peak < start) return;
  const room = 1 - start;
  const shrunk = 1 - (room * room) / (peak + room - start);
  const pale = 1 - 1 / (0.15 * (peak - shrunk) + 1);
  for (let k = 0; k < 3; k++) c[k] = (c[k] * shrunk) / peak * (1 - pale) + shrunk * pale;
}

function clip(c) {
  for (let k = 0; k < 3; k++) c[k] = Math.min(c[k], 1);
}

// The picture as it is shown. `plate` is what lies behind it, in linear light, if more than one colour.
function develop(parts, weights, tone, stops, plate) {
  const { width, height } = parts;
  const picture = new ImageData(width, height);
  const out = picture.data;
  const gain = 2 ** (tone.exposure + stops);
  const curve = tone.curve === "clip" ? clip : neutral;
  const c = [0, 0, 0];
  for (let i = 0; i < width * height; i++) {
    const alpha = coverage(parts.alpha, i);
    const behind = 1 - alpha;
    if (alpha > 0) {
      light(parts, weights, i, c);
      const k = gain / alpha;
      c[0] *= k; c[1] *= k; c[2] *= k;
      curve(c);
    } else {
      c[0] = c[1] = c[2] = 0;
    }
    for (let k = 0; k < 3; k++) {
      const back = plate ? plate[3 * i + k] : tone.backdrop[k];
      out[4 * i + k] = toByte(c[k] * alpha + back * behind);
    }
    out[4 * i + 3] = 255;
  }
  return picture;
}
