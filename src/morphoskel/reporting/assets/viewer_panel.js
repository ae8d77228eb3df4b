// The rows of the panel and the colour bars.

function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

/** Return the row of one layer: a checkbox, the quantity it is coloured by if there are several, a mesh's opacity. */
export function layerRow(layer, { toggled, chosen, faded }) {
  const { name, detail, scalars, kind } = layer.data;
  const box = element("input", { type: "checkbox", checked: layer.object.visible });
  box.addEventListener("change", () => toggled(box.checked));
  const words = [name, ...(detail ? [" ", element("small", { textContent: detail })] : [])];
  const row = element("div", { className: "mv-row" }, element("label", {}, box, element("span", {}, ...words)));
  if (scalars.length > 1) {
    const select = element("select");
    scalars.forEach(({ label }, index) => select.add(new Option(label.split(/[,(]/)[0].trim(), String(index))));
    select.value = String(layer.number);
    select.addEventListener("change", () => chosen(Number(select.value)));
    row.append(element("label", { className: "mv-option" }, "coloured by ", select));
  }
  if (kind === "mesh") {
    const slider = element("input", { type: "range", min: "0.05", max: "1", step: "0.05" });
    slider.value = String(layer.uniforms.opacity.value);
    slider.addEventListener("input", () => faded(Number(slider.value)));
    row.append(element("label", { className: "mv-option" }, "opacity ", slider));
  }
  return row;
}

// Three digits are enough to read a colour by.
function number(value) {
  return String(Number(value.toPrecision(3)));
}

/** Return the colour bar of a quantity. */
export function barElement({ label, low, high, below, above }, colours) {
  const ends = [(below ? "≤ " : "") + number(low), (above ? "≥ " : "") + number(high)];
  const strip = element("div", { className: "mv-strip" });
  const stops = colours.filter((_, index) => index % 15 === 0); // 255 = 17 * 15: both ends are among them
  strip.style.background = `linear-gradient(to right, ${stops.map((hex) => `#${hex}`).join(", ")})`;
  const bar = element(
    "div",
    { className: "mv-bar" },
    element("div", { textContent: label }),
    strip,
    element("div", { className: "mv-ends" }, ...ends.map((text) => element("span", { textContent: text }))),
  );
  bar.setAttribute("role", "img");
  bar.setAttribute("aria-label", `Colours: ${label}, from ${ends[0]} (dark blue) to ${ends[1]} (yellow)`);
  return bar;
}
