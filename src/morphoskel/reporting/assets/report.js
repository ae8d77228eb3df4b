// What the report gains by a script: a switch for light and dark, sorting, and pictures to enlarge. All of it is added
// here, so that a page without a script has no control that does nothing.
(() => {
  const root = document.documentElement;
  const darkPreferred = matchMedia("(prefers-color-scheme: dark)");

  function element(tag, properties = {}, ...children) {
    const made = Object.assign(document.createElement(tag), properties);
    made.append(...children);
    return made;
  }

  // A reader's choice is kept, where the browser lets a page from a file keep anything.
  function stored(value) {
    try {
      if (value === undefined) return localStorage.getItem("morphoskel-theme");
      if (value === null) localStorage.removeItem("morphoskel-theme");
      else localStorage.setItem("morphoskel-theme", value);
    } catch {
      // The choice lasts as long as the page.
    }
    return null;
  }

  const kept = stored();
  if (kept === "light" || kept === "dark") root.dataset.theme = kept; // before anything is drawn

  function addThemeSwitch() {
    const button = element("button", { type: "button", className: "page-button", textContent: "Dark colours" });
    const isDark = () => (root.dataset.theme ?? (darkPreferred.matches ? "dark" : "light")) === "dark";
    const tell = () => button.setAttribute("aria-pressed", String(isDark()));
    button.addEventListener("click", () => {
      const wanted = isDark() ? "light" : "dark";
      // Back at what the system prefers, the page follows it again.
      if (wanted === (darkPreferred.matches ? "dark" : "light")) delete root.dataset.theme;
      else root.dataset.theme = wanted;
      stored(root.dataset.theme ?? null);
      tell();
    });
    darkPreferred.addEventListener("change", tell);
    tell();
    document.querySelector("header").append(button);
  }

  // The lines of a method stay together: it is sorted by what this run computed.
  function sortKey(unit, index, columns) {
    const row = unit.tBodies || unit.rows ? unit.querySelector(".ours") ?? unit.rows[0] : unit;
    const cell = row.cells[row.cells.length - columns + index] ?? unit.rows[0].cells[index];
    if (cell.dataset.value !== undefined) return Number(cell.dataset.value);
    if (cell.matches(".absent, .not-run, .failed")) return NaN;
    const text = cell.textContent.trim();
    const number = text.replaceAll("−", "-").replaceAll(",", "").match(/^(?:< )?([+-]?\d+(?:\.\d+)?)/);
    return cell.tagName === "TD" && number ? Number(number[1]) : text;
  }

  function compareKeys(first, second, direction) {
    const [none, noOther] = [Number.isNaN(first), Number.isNaN(second)];
    if (none || noOther) return none - noOther; // what has no value comes last, either way
    if (typeof first === "number" && typeof second === "number") return direction * (first - second);
    return direction * String(first).localeCompare(String(second), "en", { numeric: true });
  }

  function makeSortable(table) {
    const headers = [...table.tHead.rows[0].cells];
    const units = table.tBodies.length > 1 ? [...table.tBodies] : [...table.tBodies[0].rows];
    const order = new Map(units.map((unit, place) => [unit, place]));
    headers.forEach((header, index) => {
      if (header.classList.contains("plain")) return;
      const button = element("button", { type: "button", className: "sort", title: "Sort by this column" });
      button.append(...header.childNodes);
      header.append(button);
      button.addEventListener("click", () => {
        const before = header.getAttribute("aria-sort");
        headers.forEach((other) => other.removeAttribute("aria-sort"));
        const direction = before === "ascending" ? -1 : before === "descending" ? 0 : 1;
        if (direction) header.setAttribute("aria-sort", direction > 0 ? "ascending" : "descending");
        const keys = new Map(units.map((unit) => [unit, direction && sortKey(unit, index, headers.length)]));
        const sorted = [...units].sort(
          (a, b) => (direction && compareKeys(keys.get(a), keys.get(b), direction)) || order.get(a) - order.get(b),
        );
        const parent = sorted[0].parentNode;
        const foot = parent === table ? table.tFoot : null;
        sorted.forEach((unit) => parent.insertBefore(unit, foot));
      });
    });
  }

  function addTableSwitch() {
    const tables = [...document.querySelectorAll(".result-table details")];
    const heading = document.getElementById("tables");
    if (!tables.length) return;
    const button = element("button", { type: "button", className: "page-button", textContent: "Open all tables" });
    button.addEventListener("click", () => {
      const open = button.textContent.startsWith("Open");
      tables.forEach((details) => (details.open = open));
      button.textContent = open ? "Close all tables" : "Open all tables";
    });
    heading.parentNode.querySelector("p").after(button);
  }

  function makeEnlargeable(images) {
    const title = element("h2", { className: "enlarged-title", id: "enlarged-title" });
    const actual = element("button", { type: "button", className: "page-button", textContent: "Actual size" });
    const close = element("button", { type: "button", className: "page-button", textContent: "Close", autofocus: true });
    const box = element("div", { className: "enlarged-box", tabIndex: 0 });
    const tools = element("div", { className: "enlarged-tools" }, title, actual, close);
    const dialog = element("dialog", { className: "enlarged" }, tools, box);
    dialog.setAttribute("aria-labelledby", title.id);
    document.body.append(dialog);
    const show = (isActual) => {
      box.classList.toggle("actual", isActual);
      actual.setAttribute("aria-pressed", String(isActual));
    };
    actual.addEventListener("click", () => show(!box.classList.contains("actual")));
    close.addEventListener("click", () => dialog.close());
    for (const image of images) {
      const opener = element("button", { type: "button", className: "enlarge", title: "Enlarge" });
      image.replaceWith(opener);
      opener.append(image);
      opener.addEventListener("click", () => {
        const { src, alt } = image;
        title.textContent = image.closest("section").querySelector("h3").textContent;
        box.replaceChildren(element("img", { src, alt, width: image.width, height: image.height }));
        box.firstChild.removeAttribute("width");
        box.firstChild.removeAttribute("height");
        dialog.showModal();
        // On a narrow screen the picture already is as wide as it can be.
        show(Math.min(box.clientWidth, image.naturalWidth) < 1.2 * image.clientWidth);
      });
    }
  }

  document.addEventListener("DOMContentLoaded", () => {
    addThemeSwitch();
    addTableSwitch();
    document.querySelectorAll("table.sortable").forEach(makeSortable);
    const images = document.querySelectorAll("figure img");
    if (images.length) makeEnlargeable(images);
    addEventListener("beforeprint", () => {
      document.querySelectorAll("details").forEach((details) => (details.open = true));
      images.forEach((image) => (image.loading = "eager"));
    });
  });
})();
