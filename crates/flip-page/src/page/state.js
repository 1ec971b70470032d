// What is looked at, kept in the address so that it can be sent to others.

const data = JSON.parse(document.getElementById("data").textContent);
const one = (value) => (value === undefined ? 1 : value);
const state = {
  frame: 0, // an index, the same for both sides
  sides: [0, null], // variants shown, the second where two are compared
  view: "beside", // how two are compared: beside, wipe, difference
  cut: 0.5, // where the wipe's line is, as a share of the width
  pass: null, // an index into data.passes, null for the beauty
  weights: data.passes.map(() => null), // null where each variant's own holds
  stops: 0,
};
const VIEWS = ["beside", "wipe", "difference"];

const frames = (side) => data.variants[state.sides[side]].frames;
const shot = (side) => frames(side)[Math.min(state.frame, frames(side).length - 1)];
const most = () => Math.max(1, ...state.sides.filter((v) => v !== null).map((v) => data.variants[v].frames.length));
const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

const ownWeight = (variant, i) => one(variant.weights[data.passes[i]]);
const weightOf = (variant, i) => state.weights[i] ?? ownWeight(variant, i);

// The weights that a side's picture is made with: one pass alone, or all of them.
function effective(side) {
  const variant = data.variants[state.sides[side]];
  return data.passes.map((_, i) => (state.pass === null || state.pass === i ? weightOf(variant, i) : 0));
}

// Whether a side's picture is the one that is there ready-made.
function isPlain(side) {
  const variant = data.variants[state.sides[side]];
  const same = state.weights.every((weight, i) => weight === null || weight === ownWeight(variant, i));
  return state.pass === null && state.stops === 0 && same;
}

function variantOf(id) {
  const found = data.variants.findIndex((variant) => variant.id === id);
  return found < 0 ? null : found;
}

function fromAddress() {
  const asked = new URLSearchParams(location.hash.slice(1));
  const number = Number(asked.get("frame"));
  const first = variantOf(asked.get("a") ?? "") ?? 0;
  state.sides = [first, asked.has("b") ? variantOf(asked.get("b")) : null];
  state.view = VIEWS.includes(asked.get("view")) ? asked.get("view") : "beside";
  const cut = asked.has("cut") ? Number(asked.get("cut")) : NaN;
  state.cut = Number.isFinite(cut) ? clamp(cut, 0, 1) : 0.5;
  const index = data.variants[first].frames.findIndex((frame) => frame.number === number);
  state.frame = index < 0 ? 0 : index;
  const pass = data.passes.indexOf(asked.get("pass") ?? "");
  state.pass = pass < 0 ? null : pass;
  const stops = Number(asked.get("stops"));
  state.stops = Number.isFinite(stops) ? clamp(stops, -4, 4) : 0;
  data.passes.forEach((name, i) => {
    const weight = asked.has("w." + name) ? Number(asked.get("w." + name)) : NaN;
    state.weights[i] = Number.isFinite(weight) ? clamp(weight, 0, 4) : null;
  });
}

function toAddress() {
  const said = new URLSearchParams();
  if (frames(0).length) said.set("frame", shot(0).number);
  if (data.variants[state.sides[0]].id) said.set("a", data.variants[state.sides[0]].id);
  if (state.sides[1] !== null) said.set("b", data.variants[state.sides[1]].id);
  if (state.sides[1] !== null && state.view !== "beside") said.set("view", state.view);
  if (state.sides[1] !== null && state.view === "wipe") said.set("cut", Number(state.cut.toFixed(3)));
  if (state.pass !== null) said.set("pass", data.passes[state.pass]);
  if (state.stops !== 0) said.set("stops", state.stops);
  data.passes.forEach((name, i) => {
    if (state.weights[i] !== null) said.set("w." + name, state.weights[i]);
  });
  try {
    history.replaceState(null, "", "#" + said);
  } catch {
    // Browsers limit how often; the next change will say it.
  }
}
