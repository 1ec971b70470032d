// Two variants in one picture: left and right of a line, or how far they are apart.

// How much brighter a difference is shown than it is.
const GAIN = 4;

const together = () => state.sides[1] !== null && state.view !== "beside";

// Puts both into the first canvas as soon as both are there.
function combine() {
  if (!together() || sides.some((side) => side.drawn !== side.turn)) return;
  const [a, b] = sides.map((side) => side.apart);
  const { canvas } = sides[0];
  const context = sized(canvas, a);
  context.drawImage(b, 0, 0, a.width, a.height);
  if (state.view === "wipe") {
    const cut = Math.round(state.cut * a.width);
    if (cut > 0) context.drawImage(a, 0, 0, cut, a.height, 0, 0, cut, a.height);
    context.fillStyle = "#fff";
    if (cut > 0 && cut < a.width) context.fillRect(cut, 0, 1, a.height);
  } else {
    const picture = context.getImageData(0, 0, a.width, a.height);
    const other = a.getContext("2d").getImageData(0, 0, a.width, a.height).data;
    const out = picture.data;
    for (let i = 0; i < out.length; i++) out[i] = i % 4 === 3 ? 255 : GAIN * Math.abs(out[i] - other[i]);
    context.putImageData(picture, 0, 0);
  }
  canvas.dataset.shown = sides.every((side) => side.shown) ? "exact" : "ready-made";
}

function setCut(share) {
  state.cut = clamp(share, 0, 1);
  combine();
  toAddress();
}

// What is said under both.
function captionOfBoth() {
  const between = { wipe: "  |  ", difference: "  \u2212  " }[state.view];
  const words = sides.map((side) => side.caption.textContent).join(between);
  const { canvas, caption } = sides[0];
  caption.textContent = state.view === "difference" ? `(${words})  \u00d7  ${GAIN}` : words;
  canvas.setAttribute("aria-label", `${state.view}: ${sides.map((side) => side.label).join(between)}`);
}

function compare(view) {
  const on = state.sides[1] === null || state.view !== view;
  if (!on) state.sides[1] = null;
  else if (state.sides[1] === null) state.sides[1] = (state.sides[0] + 1) % data.variants.length;
  state.view = on ? view : "beside";
  changed();
}

function showCompared() {
  const two = state.sides[1] !== null;
  byId("stage").classList.toggle("wipe", two && state.view === "wipe");
  byId("menu1").hidden = !two;
  for (const button of document.querySelectorAll("[data-view]")) {
    button.setAttribute("aria-pressed", String(two && button.dataset.view === state.view));
  }
}
