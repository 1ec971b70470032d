// What the variants were made with.

// Keys whose values are not the same for all variants.
function differing() {
  const values = new Map();
  for (const variant of data.variants) {
    for (const [key, value] of variant.parameters) {
      if (!values.has(key)) values.set(key, []);
      values.get(key).push(value);
    }
  }
  const differs = ([, all]) => all.length !== data.variants.length || all.some((value) => value !== all[0]);
  return new Set([...values].filter(differs).map(([key]) => key));
}
const DIFFERING = differing();

function showParameters() {
  const shown = state.sides.filter((variant) => variant !== null).map((variant) => data.variants[variant]);
  const only = byId("only-differing").checked;
  const keys = [];
  for (const variant of shown) {
    for (const [key] of variant.parameters) if (!keys.includes(key)) keys.push(key);
  }
  const head = element("tr", {}, element("th", { scope: "col" }, "key"));
  for (const variant of shown) head.append(element("th", { scope: "col" }, variant.id || "value"));
  const rows = keys.filter((key) => !only || DIFFERING.has(key)).map((key) => {
    const row = element("tr", { class: DIFFERING.has(key) ? "differs" : null }, element("th", { scope: "row" }, key));
    for (const variant of shown) {
      const found = variant.parameters.find(([other]) => other === key);
      row.append(element("td", {}, found ? found[1] : "\u2013"));
    }
    return row;
  });
  byId("parameters").replaceChildren(element("thead", {}, head), element("tbody", {}, ...rows));
}
