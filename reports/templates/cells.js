// Cells of maps: a click on one, or the arrow keys, show its sheet. Figures whose maps are known by their places on the
// picture carry those; the sheets come deflated. Without this script the page shows maps, tables and captions.
(async () => {
  "use strict";
  const dock = document.getElementById("cell"), packed = document.getElementById("cells-data").textContent.trim();
  const bytes = Uint8Array.from(atob(packed), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  const cells = await new Response(stream).json();
  const figures = [...document.querySelectorAll("figure[data-places]")], slim = matchMedia("(max-width: 44rem)");
  const find = (part) => dock.querySelector(part);
  const TOP = 16, HIGH = 84, LEFT = 40, WIDE = 270, STEPS = 999;
  let chosen = null, used = figures[0], point = null; // point: page, x, y from which a step goes on

  const placesOf = (figure) => JSON.parse(figure.dataset.places)[slim.matches ? 1 : 0];
  const at = (page, x, y) => cells.findLast((one) =>
    one.page === page && one.box[0] <= x && x <= one.box[1] && one.box[2] <= y && y <= one.box[3]);

  function curve(kind, colour, across, up) {
    const dots = kind === "dots" ? "h0" : "";
    const steps = up.map((value, i) => {
      const x = LEFT + WIDE * (across ? across[i] / STEPS : i / Math.max(1, up.length - 1));
      return (i && !dots ? "L" : "M") + x.toFixed(1) + " " + (TOP + HIGH * (1 - value / STEPS)).toFixed(1) + dots;
    });
    return `<path class="${kind}" style="stroke: ${colour || "var(--ink)"}" d="${steps.join("")}"/>`;
  }

  function draw(svg, cell, title, low, high, curves, ends) {
    const said = (value, x, y, anchor = "") => `<text class="${anchor}" x="${x}" y="${y}">${value}</text>`;
    const drawn = cell.motions.map(curves).join("");
    svg.style.display = drawn.includes("M") ? "" : "none"; // a run without a record, or a cell without a run
    svg.innerHTML = `<path class="axes" d="M${LEFT} ${TOP}v${HIGH}h${WIDE}"/>` + said(title, LEFT, TOP - 5) +
      said(high, LEFT - 4, TOP + 8, "e") + said(low, LEFT - 4, TOP + HIGH, "e") +
      said(ends[0], LEFT, TOP + HIGH + 14) + said(ends[1], LEFT + WIDE, TOP + HIGH + 14, "e") +
      drawn;
  }

  function show(cell) {
    chosen = cell;
    dock.hidden = false;
    find("[role=status]").textContent = `${cell.name}: ${cell.motions.length || "no"} motion${cell.motions.length === 1 ? "" : "s"} computed. ${cell.note}`;
    const [r, T] = [cell.scales[0], cell.scales[1].map((value) => Number((value / 1e3).toFixed(1)))];
    const [tension, radius, section] = dock.querySelectorAll("svg");
    draw(tension, cell, "T (kN)", ...T, (one) => curve("line", one.colour, null, one.series[1]), ["last 4 wave periods", ""]);
    draw(radius, cell, "r (m)", ...r, (one) => curve("line", one.colour, null, one.series[0]), ["last 4 wave periods", ""]);
    draw(section, cell, "once a period: largest T (kN) over r (m)", ...T,
         (one) => curve("dots", one.colour, one.series[2], one.series[3]), r);
    const put = (row, tag, texts) => {
      row.replaceChildren(row.firstElementChild, ...cell.motions.map((one, i) => {
        const entry = document.createElement(tag);
        entry.textContent = texts(one, i);
        if (tag === "th") Object.assign(entry, { scope: "col" }).style.borderColor = one.colour;
        return entry;
      }));
      row.hidden = [...row.children].slice(1).every((entry) => entry.textContent === "–");
    };
    put(find("thead tr"), "th", (one) => one.motion);
    dock.querySelectorAll("tbody tr").forEach((row, i) => put(row, "td", (one) => one.facts[i]));
    find("ul").replaceChildren(...cell.motions.map((one) => {
      const line = document.createElement("li");
      line.textContent = `${one.motion}: ${one.said}.`;
      return line;
    }));
    mark();
  }

  function mark() {
    for (const figure of figures) {
      figure.querySelectorAll(".chosen").forEach((one) => one.remove());
      if (!chosen || dock.hidden) continue;
      for (const [[left, top, wide, high], [x0, x1, y0, y1], page] of placesOf(figure)) {
        if (page !== chosen.page) continue;
        const box = document.createElement("span"), [a, b, c, d] = chosen.box, percent = (share) => `${100 * share}%`;
        box.className = "chosen";
        box.style.left = percent(left + wide * (a - x0) / (x1 - x0));
        box.style.top = percent(top + high * (y1 - d) / (y1 - y0));
        box.style.width = percent(wide * (b - a) / (x1 - x0));
        box.style.height = percent(high * (d - c) / (y1 - y0));
        figure.querySelector("picture").append(box);
      }
    }
    used.querySelector(".chosen")?.scrollIntoView({ block: "nearest" });
  }

  function step(right, up) {
    const [[, [x0, x1, y0, y1], page]] = placesOf(used);
    if (!chosen || dock.hidden) {
      point = { page, x: (x0 + x1) / 2, y: (y0 + y1) / 2 };
    } else {
      const [a, b, c, d] = chosen.box, past = 1e-4;
      const x = right ? (right > 0 ? b + past * (b - a) : a - past * (b - a)) : point.x;
      const y = up ? (up > 0 ? d + past * (d - c) : c - past * (d - c)) : point.y;
      const next = at(point.page, x, y);
      if (!next) return;
      point = { page: point.page, x: right ? (next.box[0] + next.box[1]) / 2 : x, y: up ? (next.box[2] + next.box[3]) / 2 : y };
    }
    const found = at(point.page, point.x, point.y);
    if (found) show(found);
  }

  function close() {
    dock.hidden = true;
    mark();
    used.querySelector("picture").focus();
  }

  const keys = { ArrowLeft: () => step(-1, 0), ArrowRight: () => step(1, 0), ArrowUp: () => step(0, 1),
                 ArrowDown: () => step(0, -1), Escape: close };
  function pressed(event) {
    if (!keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    keys[event.key]();
  }
  for (const figure of figures) {
    const picture = figure.querySelector("picture");
    picture.tabIndex = 0;
    picture.setAttribute("role", "application");
    picture.setAttribute("aria-label", "Map: arrow keys choose a cell, Escape closes its sheet");
    picture.addEventListener("focus", () => { used = figure; });
    picture.addEventListener("keydown", pressed);
    picture.addEventListener("click", (event) => {
      used = figure;
      const box = picture.getBoundingClientRect();
      const u = (event.clientX - box.left) / box.width, v = (event.clientY - box.top) / box.height;
      for (const [[left, top, wide, high], [x0, x1, y0, y1], page] of placesOf(figure)) {
        const x = x0 + (u - left) / wide * (x1 - x0), y = y1 - (v - top) / high * (y1 - y0), found = at(page, x, y);
        if (!found) continue;
        point = { page, x, y };
        show(found);
      }
    });
  }
  dock.addEventListener("keydown", (event) => { if (event.key === "Escape") close(); });
  for (const button of dock.querySelectorAll("button")) button.addEventListener("click", keys[button.value]);
  slim.addEventListener("change", mark);
  document.getElementById("cells-hint").hidden = false;
})();
