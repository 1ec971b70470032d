// What is turned and pressed.

function element(name, attributes, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === true) made.setAttribute(key, "");
    else if (value !== false && value !== null) made.setAttribute(key, value);
  }
  made.append(...children);
  return made;
}

let drawing = false;
function changed() {
  if (drawing) return;
  drawing = true;
  requestAnimationFrame(() => {
    drawing = false;
    show();
  });
}

function setFrame(index) {
  const count = most();
  state.frame = ((index % count) + count) % count;
  changed();
}

// One menu for each axis, for each side.
function menus(side, host) {
  host.replaceChildren();
  data.axes.forEach((axis, a) => {
    const id = `axis${side}-${a}`;
    const menu = element("select", { id });
    axis.settings.forEach((name, i) => menu.append(element("option", { value: i }, name)));
    menu.addEventListener("change", () => {
      const settings = [...data.variants[state.sides[side]].settings];
      settings[a] = axis.settings[Number(menu.value)];
      const same = (variant) => variant.settings.every((name, i) => name === settings[i]);
      // Not every combination need be there.
      const near = data.variants.findIndex((variant) => variant.settings[a] === settings[a]);
      const found = data.variants.findIndex(same);
      state.sides[side] = found < 0 ? near : found;
      changed();
    });
    host.append(element("label", { for: id }, axis.name), menu);
  });
}

function showMenus(side) {
  if (state.sides[side] === null) return;
  const { settings } = data.variants[state.sides[side]];
  data.axes.forEach((axis, a) => {
    byId(`axis${side}-${a}`).value = axis.settings.indexOf(settings[a]);
  });
}

function passControls() {
  const host = byId("passes");
  const button = (name, index) => {
    const made = element("button", { type: "button", "aria-pressed": "false", "data-pass": index ?? "beauty" }, name);
    made.addEventListener("click", () => {
      state.pass = index;
      changed();
    });
    return made;
  };
  host.append(element("div", { class: "pass" }, button("beauty", null), element("span", {}, "key 0")));
  data.passes.forEach((name, i) => {
    const weight = element("input", {
      type: "range", min: 0, max: 4, step: 0.05, id: `weight${i}`, "aria-label": `weight of ${name}`,
    });
    weight.addEventListener("input", () => {
      state.weights[i] = Number(weight.value);
      changed();
    });
    const said = element("output", { for: `weight${i}`, id: `said${i}` });
    host.append(element("div", { class: "pass" }, button(name, i), weight, said));
  });
  byId("reset").addEventListener("click", () => {
    state.weights = data.passes.map(() => null);
    state.stops = 0;
    state.pass = null;
    changed();
  });
  byId("stops").addEventListener("input", (event) => {
    state.stops = Number(event.target.value);
    changed();
  });
}

function showPasses() {
  for (const button of byId("passes").querySelectorAll("button")) {
    const own = button.dataset.pass === "beauty" ? null : Number(button.dataset.pass);
    button.setAttribute("aria-pressed", String(own === state.pass));
  }
  data.passes.forEach((_, i) => {
    const weight = weightOf(data.variants[state.sides[0]], i);
    byId(`weight${i}`).value = weight;
    byId(`said${i}`).textContent = "\u00d7 " + weight.toFixed(2);
  });
  byId("stops").value = state.stops;
  byId("said-stops").textContent = (state.stops > 0 ? "+" : "") + state.stops.toFixed(1);
}

let playing = null;
function play(on) {
  if (playing !== null) clearInterval(playing);
  playing = on ? setInterval(() => setFrame(state.frame + 1), 1000 / data.fps) : null;
  byId("play").setAttribute("aria-pressed", String(on));
  byId("play").textContent = on ? "Pause" : "Play";
}

function pointers() {
  let start = null;
  const isWiped = () => together() && state.view === "wipe";
  sides.forEach(({ canvas }, side) => {
    const shareOf = (event) => {
      const box = canvas.getBoundingClientRect();
      return (event.clientX - box.left) / box.width;
    };
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      start = { x: event.clientX, frame: state.frame };
      if (isWiped()) setCut(shareOf(event));
      else play(false);
    });
    canvas.addEventListener("pointermove", (event) => {
      byId("readout").textContent = readout(side, event);
      if (!start) return;
      if (isWiped()) return setCut(shareOf(event));
      // Across the picture is once around.
      const share = (event.clientX - start.x) / canvas.getBoundingClientRect().width;
      setFrame(start.frame + Math.round(share * most()));
    });
    for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, () => (start = null));
    canvas.addEventListener("pointerleave", () => (byId("readout").textContent = ""));
  });
}

const VIEW_KEYS = { c: "beside", w: "wipe", d: "difference" };

function keys() {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("select, input, textarea")) return;
    const pass = Number(event.key);
    if (event.key === "ArrowRight") setFrame(state.frame + 1);
    else if (event.key === "ArrowLeft") setFrame(state.frame - 1);
    else if (event.key === "Home") setFrame(0);
    else if (event.key === "End") setFrame(most() - 1);
    else if (event.key === " " && !event.target.closest("button, summary")) play(playing === null);
    else if (event.key in VIEW_KEYS && data.variants.length > 1) compare(VIEW_KEYS[event.key]);
    else if (event.key === "[") setCut(state.cut - 0.05);
    else if (event.key === "]") setCut(state.cut + 0.05);
    else if (event.key === "x" && state.sides[1] !== null) state.sides.reverse(), changed();
    else if (event.key === "0") (state.pass = null), changed();
    else if (pass >= 1 && pass <= data.passes.length) (state.pass = pass - 1), changed();
    else return;
    event.preventDefault();
  });
}
