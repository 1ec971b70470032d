// Everything brought together.

let parametersOf = "";
function show() {
  const frame = byId("frame");
  frame.max = most() - 1;
  frame.value = state.frame;
  byId("said-frame").textContent = frames(0).length ? `${shot(0).number} / ${most()}` : "no frames";
  showCompared();
  [0, 1].forEach(showMenus);
  showPasses();
  const wanted = state.sides.join();
  if (wanted !== parametersOf) {
    parametersOf = wanted;
    showParameters();
  }
  toAddress();
  const done = Promise.all([draw(0), draw(1)]);
  if (together()) captionOfBoth();
  // For whoever drives the page: what was asked for last is on the screen.
  document.documentElement.dataset.busy = "true";
  const turn = sides.map((side) => side.turn).join();
  done.catch((fault) => (byId("fault").textContent = "A picture cannot be shown: " + fault)).finally(() => {
    if (turn === sides.map((side) => side.turn).join()) document.documentElement.dataset.busy = "false";
  });
}

fromAddress();
[0, 1].forEach((side) => menus(side, byId("menu" + side)));
byId("variants").hidden = data.variants.length < 2;
byId("weigh").hidden = data.passes.length === 0;
passControls();
pointers();
keys();
byId("frame").addEventListener("input", (event) => {
  play(false);
  setFrame(Number(event.target.value));
});
byId("play").addEventListener("click", () => play(playing === null));
for (const button of document.querySelectorAll("[data-view]")) {
  button.addEventListener("click", () => compare(button.dataset.view));
}
byId("only-differing").addEventListener("change", showParameters);
byId("only-differing").parentElement.hidden = data.variants.length < 2;
addEventListener("hashchange", () => {
  fromAddress();
  changed();
});
document.documentElement.dataset.ready = "true";
show();
