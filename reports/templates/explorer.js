// The explorer: the points of a diagram on a canvas, to zoom, to pan, and to choose a run whose sheet is then shown.
// Everything it needs is in the page; without it the page shows the still diagram and all sheets below one another.
(() => {
  "use strict";
  const root = document.getElementById("explorer");
  const data = JSON.parse(document.getElementById("explorer-data").textContent);
  const canvas = root.querySelector("canvas"), list = root.querySelector("select");
  const status = root.querySelector("[role=status]"), place = document.getElementById("explorer-sheet");
  const columns = data.columns;

  // what is seen: ends of both axes; x in the parameter, y in the unit of the points
  const at = columns.map((column) => column.at);
  const wide = Math.max(...at) - Math.min(...at) || Math.abs(at[0]) || 1, high = data.high - data.low;
  const whole = { x0: Math.min(...at) - 0.03 * wide, x1: Math.max(...at) + 0.03 * wide,
                  y0: data.low - 0.04 * high, y1: data.high + 0.04 * high };
  let view = { ...whole }, chosen = -1, dragged = null;
  const LEFT = 48, RIGHT = 10, TOP = 20, LOWER = 66, GAP = 26, BOTTOM = 44;
  // how far the nearest other value of the parameter is: a column is as wide as its place allows
  const room = at.map((one) => Math.min(...at.map((other) => Math.abs(one - other)).filter((gap) => gap > 0), wide));

  const width = () => canvas.clientWidth, height = () => canvas.clientHeight;
  const floor = () => height() - BOTTOM - data.lower.length * (LOWER + GAP); // lower edge of the upper panel, px
  const across = (value) => LEFT + (value - view.x0) / (view.x1 - view.x0) * (width() - LEFT - RIGHT);
  const back = (pixel) => view.x0 + (pixel - LEFT) / (width() - LEFT - RIGHT) * (view.x1 - view.x0);
  const down = (value) => TOP + (view.y1 - value) / (view.y1 - view.y0) * (floor() - TOP);

  function ticks(low, high, most) {
    const raw = (high - low) / most, power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].find((factor) => factor * power >= raw) * power;
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9)), found = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) {
      found.push([k * step, (k * step).toFixed(digits).replace("-", "−")]);
    }
    return found;
  }

  function frame(pen, colours, top, bottom, low, high, label) {
    pen.strokeStyle = colours.line;
    pen.lineWidth = 1;
    pen.fillStyle = colours.soft;
    pen.textAlign = "right";
    pen.textBaseline = "middle";
    for (const [value, said] of ticks(low, high, Math.max(2, (bottom - top) / 45))) {
      const y = Math.round(bottom - (value - low) / (high - low) * (bottom - top)) + 0.5;
      pen.beginPath();
      pen.moveTo(LEFT, y);
      pen.lineTo(width() - RIGHT, y);
      pen.stroke();
      pen.fillText(said, LEFT - 6, y);
    }
    pen.strokeStyle = colours.soft;
    pen.strokeRect(LEFT + 0.5, top + 0.5, width() - LEFT - RIGHT - 1, bottom - top - 1);
    pen.textAlign = "left";
    pen.textBaseline = "alphabetic";
    pen.fillText(label, LEFT, top - 5);
  }

  function inside(pen, top, bottom, drawing) {
    pen.save();
    pen.beginPath();
    pen.rect(LEFT, top, width() - LEFT - RIGHT, bottom - top);
    pen.clip();
    drawing();
    pen.restore();
  }

  // a run without points is there to be chosen too
  function drawCross(pen, x, colour) {
    const y = floor() - 8;
    pen.strokeStyle = colour;
    pen.lineWidth = 1.5;
    pen.beginPath();
    for (const slope of [-1, 1]) {
      pen.moveTo(x - 4, y - 4 * slope);
      pen.lineTo(x + 4, y + 4 * slope);
    }
    pen.globalAlpha = 1;
    pen.stroke();
    pen.globalAlpha = 0.55;
    pen.lineWidth = 1;
  }

  function drawPoints(pen, colours) {
    const scale = (width() - LEFT - RIGHT) / (view.x1 - view.x0);
    pen.globalAlpha = 0.55;
    columns.forEach((column, index) => {
      const x = across(column.at), half = Math.max(0.75, Math.min(0.4 * room[index] * scale, 6));
      if (x < LEFT - 8 || x > width() + 8) return;
      pen.fillStyle = index === chosen ? colours.mark : column.shown || colours.points;
      if (!column.points.length) drawCross(pen, x, index === chosen ? colours.mark : colours.soft);
      for (const point of column.points) {
        pen.fillRect(x - half, down(point) - 0.75, 2 * half, 1.5);
      }
    });
    pen.globalAlpha = 1;
  }

  function drawLower(pen, colours, curve, top, bottom) {
    const known = curve.values.flatMap((value, i) => value === null ? [] :
      [value - (curve.errors[i] || 0), value + (curve.errors[i] || 0)]);
    const low = Math.min(0, ...known), high = Math.max(low + 1e-9, 0.02, ...known) * 1.08;
    frame(pen, colours, top, bottom, low, high, curve.label);
    const to = (value) => bottom - (value - low) / (high - low) * (bottom - top);
    inside(pen, top, bottom, () => {
      curve.values.forEach((value, i) => {
        if (value === null) return;
        const x = across(columns[i].at), error = curve.errors[i];
        pen.strokeStyle = pen.fillStyle = i === chosen ? colours.mark : columns[i].shown || colours.points;
        pen.beginPath();
        pen.moveTo(x, to(error === null ? 0 : value - error));
        pen.lineTo(x, to(error === null ? value : value + error));
        pen.stroke();
        pen.beginPath();
        pen.arc(x, to(value), i === chosen ? 4 : 2.5, 0, 7);
        pen.fill();
      });
    });
  }

  function draw() {
    const density = window.devicePixelRatio || 1, style = getComputedStyle(document.documentElement);
    const colour = (name) => style.getPropertyValue(name).trim();
    const colours = { ink: colour("--ink"), soft: colour("--soft"), line: colour("--line"), points: colour("--accent"),
                      mark: colour(columns.some((column) => column.colour) ? "--ink" : "--warn") };
    const dark = matchMedia("(prefers-color-scheme: dark)").matches;
    for (const column of columns) { // dark colours become light on a dark page
      column.shown = column.colour && dark ? `color-mix(in srgb, ${column.colour}, white 35%)` : column.colour;
    }
    canvas.width = Math.round(width() * density);
    canvas.height = Math.round(height() * density);
    const pen = canvas.getContext("2d");
    pen.scale(density, density);
    pen.clearRect(0, 0, width(), height());
    pen.font = "12px " + getComputedStyle(canvas).fontFamily;
    frame(pen, colours, TOP, floor(), view.y0, view.y1, data.y_label);
    data.lower.forEach((curve, i) => {
      const top = floor() + GAP + i * (LOWER + GAP);
      drawLower(pen, colours, curve, top, top + LOWER);
    });
    inside(pen, TOP, height() - BOTTOM, () => {
      if (chosen >= 0) {
        const x = Math.round(across(columns[chosen].at)) + 0.5;
        pen.strokeStyle = colours.mark;
        pen.setLineDash([4, 3]);
        pen.beginPath();
        pen.moveTo(x, TOP);
        pen.lineTo(x, height() - BOTTOM);
        pen.stroke();
        pen.setLineDash([]);
      }
    });
    inside(pen, TOP, floor(), () => drawPoints(pen, colours));
    pen.fillStyle = colours.soft;
    pen.textAlign = "center";
    pen.textBaseline = "alphabetic";
    for (const [value, said] of ticks(view.x0, view.x1, Math.max(2, (width() - LEFT) / 90))) {
      pen.fillText(said, Math.min(across(value), width() - pen.measureText(said).width / 2), height() - BOTTOM + 16);
    }
    pen.fillText(data.x_label, (LEFT + width() - RIGHT) / 2, height() - 8);
  }

  // factor < 1 comes nearer; (fx, fy) is the place on the canvas, in shares, that stays where it is
  function zoom(factor, fx = 0.5, fy = 0.5) {
    const stretch = (a, b, f, bound) => {
      const span = Math.min(bound, (b - a) * factor), fixed = a + f * (b - a);
      return [fixed - f * span, fixed + (1 - f) * span];
    };
    const [x0, x1] = stretch(view.x0, view.x1, fx, whole.x1 - whole.x0);
    const [y0, y1] = stretch(view.y0, view.y1, fy, whole.y1 - whole.y0);
    if (x1 - x0 < 1e-6 * wide || y1 - y0 < 1e-6 * high) return;
    view = { x0, x1, y0, y1 };
    pan(0, 0);
  }

  // by shares of what is seen; never beyond the whole
  function pan(right, up) {
    const shift = (a, b, share, low, high) => {
      const by = Math.max(low - a, Math.min(high - b, share * (b - a)));
      return [a + by, b + by];
    };
    [view.x0, view.x1] = shift(view.x0, view.x1, right, whole.x0, whole.x1);
    [view.y0, view.y1] = shift(view.y0, view.y1, up, whole.y0, whole.y1);
    draw();
  }

  function choose(index) {
    if (index < 0 || index >= columns.length) return;
    chosen = index;
    const column = columns[index], margin = 0.02 * (view.x1 - view.x0);
    list.selectedIndex = index + 1;
    if (column.at < view.x0 + margin || column.at > view.x1 - margin) { // a run chosen from the list comes into view
      pan((column.at - (view.x0 + view.x1) / 2) / (view.x1 - view.x0), 0);
    }
    const sheet = document.getElementById(column.anchor).cloneNode(true);
    sheet.removeAttribute("id");
    sheet.querySelectorAll("[id]").forEach((inner) => inner.removeAttribute("id"));
    place.replaceChildren(sheet);
    place.dataset.run = column.anchor;
    status.textContent = "Shown below: " + column.name + ".";
    draw();
  }

  function step(by) {
    choose(chosen < 0 ? (by > 0 ? 0 : columns.length - 1) : Math.max(0, Math.min(columns.length - 1, chosen + by)));
  }

  function whereOn(event) {
    const box = canvas.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  canvas.addEventListener("pointerdown", (event) => {
    dragged = { ...whereOn(event), moved: false, from: { ...view } };
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!dragged) return;
    const here = whereOn(event);
    if (Math.hypot(here.x - dragged.x, here.y - dragged.y) > 4) dragged.moved = true;
    if (!dragged.moved) return;
    view = { ...dragged.from };
    pan((dragged.x - here.x) / (width() - LEFT - RIGHT), (here.y - dragged.y) / (floor() - TOP));
  });
  canvas.addEventListener("pointerup", (event) => {
    const click = dragged && !dragged.moved;
    dragged = null;
    if (!click) return;
    const here = whereOn(event), value = back(here.x);
    // of several motions at the nearest value, that of the nearest point
    const off = at.map((one) => Math.abs(one - value)), least = Math.min(...off);
    const above = columns.map((column) => Math.min(1e9, ...column.points.map((point) => Math.abs(down(point) - here.y))));
    choose(at.reduce((best, _, i) => off[i] === least && (best < 0 || above[i] < above[best]) ? i : best, -1));
  });
  canvas.addEventListener("pointercancel", () => { dragged = null; });
  // only a diagram that has the focus takes the wheel: the page scrolls over all others
  canvas.addEventListener("wheel", (event) => {
    if (document.activeElement !== canvas && !event.ctrlKey) return;
    event.preventDefault();
    const here = whereOn(event);
    const share = (value) => Math.max(0, Math.min(1, value));
    zoom(2 ** (event.deltaY / 300), share((here.x - LEFT) / (width() - LEFT - RIGHT)),
         share((floor() - here.y) / (floor() - TOP)));
  }, { passive: false });
  const keys = {
    "+": () => zoom(0.7), "=": () => zoom(0.7), "-": () => zoom(1 / 0.7), "0": reset, "Home": reset,
    "ArrowLeft": () => step(-1), "ArrowRight": () => step(1),
    "a": () => pan(-0.2, 0), "d": () => pan(0.2, 0), "w": () => pan(0, 0.2), "s": () => pan(0, -0.2),
  };
  canvas.addEventListener("keydown", (event) => {
    const act = keys[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
  });
  function reset() {
    view = { ...whole };
    draw();
  }
  const buttons = { in: () => zoom(0.7), out: () => zoom(1 / 0.7), whole: reset, before: () => step(-1), after: () => step(1) };
  for (const button of root.querySelectorAll("button")) button.addEventListener("click", buttons[button.value]);
  columns.forEach((column) => list.add(new Option(column.name)));
  list.addEventListener("change", () => choose(list.selectedIndex - 1));
  new ResizeObserver(draw).observe(canvas);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
  // a link to a sheet opens it
  function unfold() {
    const sheet = document.getElementById(location.hash.slice(1))?.closest("details");
    if (!sheet || sheet.open) return;
    sheet.open = true;
    sheet.scrollIntoView();
  }
  addEventListener("hashchange", unfold);
  root.hidden = false;
  unfold();
  draw();
})();
