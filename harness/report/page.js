"use strict";
// Draws what stands in #data. Each figure: id, title, x and y {label, log}, map, bands, categories, curves.

const dark = window.matchMedia("(prefers-color-scheme: dark)");
const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

/// The same hue for either background: the truth is black on white and white on black, the others are mixed
/// with a third of white on dark paper.
function shade(colour) {
  if (!dark.matches) return colour;
  const parts = [1, 3, 5].map((i) => parseInt(colour.slice(i, i + 2), 16));
  const mixed = colour === "#000000" ? [228, 232, 235] : parts.map((part) => Math.round(part + (255 - part) / 3));
  return `rgb(${mixed.join(",")})`;
}

/// What the user has hidden or zoomed into stays as it is.
function colourise(chart) {
  chart.data.datasets.forEach((set, i) => {
    const colour = shade(chart.figure.curves[i].colour);
    const isHollow = chart.figure.curves[i].mark === "circles";
    const fill = isHollow ? "transparent" : colour;
    Object.assign(set, { borderColor: colour, backgroundColor: fill, pointBorderColor: colour });
  });
  for (const scale of Object.values(chart.options.scales)) {
    scale.grid.color = css("--rule");
    scale.grid.borderColor = css("--rule");
    scale.ticks.color = css("--faint");
    scale.title.color = css("--faint");
  }
  chart.options.plugins.legend.labels.color = css("--ink");
}

/// The last one lies on top.
function dataset(curve, index, { length }) {
  const isLine = curve.mark === "line" || curve.mark === "thin";
  return {
    label: curve.name,
    order: length - index,
    hidden: curve.hidden,
    data: curve.x.map((x, i) => ({ x, y: curve.y[i] })),
    showLine: isLine,
    borderWidth: curve.mark === "line" ? 1.8 : 1,
    pointRadius: isLine ? 0 : (curve.mark === "circles" ? 4 : 2.5) * (curve.x.length > 500 ? 0.5 : 1),
    pointHoverRadius: isLine ? 3 : 5,
    pointHitRadius: 4,
    pointStyle: curve.mark === "crosses" ? "crossRot" : "circle",
  };
}

const bands = (figure) => ({
  id: "bands",
  beforeDatasetsDraw(chart) {
    const { ctx, chartArea: area, scales } = chart;
    ctx.save();
    ctx.fillStyle = css("--band");
    for (const band of figure.bands) {
      const top = Math.max(scales.y.getPixelForValue(band.high), area.top);
      const bottom = Math.min(scales.y.getPixelForValue(band.low), area.bottom);
      if (bottom > top) ctx.fillRect(area.left, top, area.width, bottom - top);
    }
    ctx.restore();
  },
});

/// What lies on the ground of a map: patches, then what is solid, the landmarks in their true size.
const ground = (figure) => ({
  id: "ground",
  beforeDatasetsDraw(chart) {
    const { ctx, chartArea: area, scales: { x, y } } = chart;
    ctx.save();
    ctx.beginPath();
    ctx.rect(area.left, area.top, area.width, area.height);
    ctx.clip();
    for (const shape of figure.areas) {
      ctx.fillStyle = css(shape.solid ? "--solid" : "--patch");
      ctx.beginPath();
      shape.x.forEach((px, i) => ctx.lineTo(x.getPixelForValue(px), y.getPixelForValue(shape.y[i])));
      ctx.fill();
    }
    ctx.fillStyle = css("--solid");
    figure.discs.radius.forEach((radius, i) => {
      const px = x.getPixelForValue(figure.discs.x[i]);
      const reach = Math.abs(x.getPixelForValue(figure.discs.x[i] + radius) - px);
      ctx.beginPath();
      ctx.arc(px, y.getPixelForValue(figure.discs.y[i]), reach, 0, 2 * Math.PI);
      ctx.fill();
    });
    ctx.restore();
  },
});

/// The nearest point of a curve that has something to say. A landmark counts as nearer than it is, because it
/// says more than a point of a trajectory.
Chart.Interaction.modes.telling = (chart, event) => {
  const at = Chart.helpers.getRelativePosition(event, chart);
  const { left, right, top, bottom } = chart.chartArea;
  if (at.x < left || at.x > right || at.y < top || at.y > bottom) return [];
  let nearest = [];
  let least = Infinity;
  for (const { data, index: datasetIndex } of chart.getSortedVisibleDatasetMetas()) {
    const curve = chart.figure.curves[datasetIndex];
    if (curve.silent) continue;
    data.forEach((element, index) => {
      if (element.skip) return;
      const apart = Math.hypot(element.x - at.x, element.y - at.y) - (curve.landmarks ? 8 : 0);
      if (apart >= least) return;
      least = apart;
      nearest = [{ element, datasetIndex, index }];
    });
  }
  return nearest;
};

/// Powers of ten with few landmarks between them, as in 1, 2, 5.
function tick(figure, axis) {
  return function (value) {
    if (axis === "x" && figure.categories.length) return figure.categories[value] ?? "";
    if (figure[axis].log) {
      const first = Number((value / 10 ** Math.floor(Math.log10(value) + 1e-9)).toFixed(6));
      if (![1, 2, 5].includes(first)) return "";
      return value >= 1e-3 && value < 1e6 ? String(Number(value.toPrecision(3))) : value.toExponential(0);
    }
    return String(Number(value.toPrecision(6)));
  };
}

function scale(figure, axis) {
  const isCategories = axis === "x" && figure.categories.length > 0;
  return {
    type: figure[axis].log ? "logarithmic" : "linear",
    title: { display: true, text: figure[axis].label },
    grid: { borderColor: "", color: "" },
    ticks: {
      callback: tick(figure, axis),
      maxRotation: isCategories ? 50 : 0,
      autoSkipPadding: 12,
      includeBounds: false,
    },
    ...(isCategories
      ? {
          min: -0.5,
          max: figure.categories.length - 0.5,
          afterBuildTicks(built) {
            built.ticks = figure.categories.map((_, value) => ({ value }));
          },
        }
      : {}),
  };
}

/// One entry for all curves of a name.
function legend() {
  return {
    position: "bottom",
    reverse: true,  // Chart.js begins with what lies on top
    labels: {
      usePointStyle: true,
      pointStyle: "rectRounded",
      generateLabels: (chart) => Chart.defaults.plugins.legend.labels.generateLabels(chart).map((item) =>
        ({ ...item, fillStyle: shade(chart.figure.curves[item.datasetIndex].colour), lineWidth: 0 })),
      filter: (item, data) => data.datasets.findIndex((set) => set.label === item.text) === item.datasetIndex,
    },
    onClick(_, item, { chart }) {
      const isVisible = chart.isDatasetVisible(item.datasetIndex);
      chart.data.datasets.forEach((set, i) => {
        if (set.label === item.text) chart.setDatasetVisibility(i, !isVisible);
      });
      chart.update("none");
    },
  };
}

const number = (value) => String(Number(value.toPrecision(5)));

/// Name, estimate, truth, error and sigma, as far as they are known.
function aboutLandmark(curve, index) {
  const { id, true_x: trueX, true_y: trueY, sd_x: sdX, sd_y: sdY } = curve.landmarks;
  const [x, y] = [curve.x[index], curve.y[index]];
  const name = id[index] < 0 ? "not in the world" : `landmark ${id[index]}`;
  if (curve.mark === "circles") return [`${curve.name}: ${name}`, `at ${number(x)}, ${number(y)} m`];
  const lines = [`${curve.name}: ${name}`, `estimate ${number(x)}, ${number(y)} m`];
  if (trueX[index] !== null) {
    lines.push(`truth ${number(trueX[index])}, ${number(trueY[index])} m`);
    lines.push(`error ${Math.hypot(x - trueX[index], y - trueY[index]).toPrecision(3)} m`);
  }
  if (sdX[index] !== null) lines.push(`sigma ${sdX[index].toPrecision(3)}, ${sdY[index].toPrecision(3)} m along x, y`);
  return lines;
}

function tooltip(figure) {
  return {
    callbacks: {
      title: () => "",
      label: (item) => {
        const curve = figure.curves[item.datasetIndex];
        if (curve.landmarks) return aboutLandmark(curve, item.dataIndex);
        const x = figure.categories[item.parsed.x] ?? number(item.parsed.x);
        return `${item.dataset.label}: ${x}, ${number(item.parsed.y)}`;
      },
    },
  };
}

function setRange(chart, ranges) {
  for (const axis of ["x", "y"]) {
    Object.assign(chart.options.scales[axis], { min: ranges[axis][0], max: ranges[axis][1] });
  }
  chart.update("none");
}

/// The ranges with metres as long along x as along y: the shorter one grows about its middle.
function squared(chart, ranges) {
  const { width, height } = chart.chartArea;
  const perPixel = Math.max((ranges.x[1] - ranges.x[0]) / width, (ranges.y[1] - ranges.y[0]) / height);
  const grown = ([low, high], pixels) => {
    const middle = (low + high) / 2;
    return [middle - (perPixel * pixels) / 2, middle + (perPixel * pixels) / 2];
  };
  return { x: grown(ranges.x, width), y: grown(ranges.y, height) };
}

function show(chart, ranges) {
  setRange(chart, ranges);
  // Twice: labels of other lengths change the area that the first was meant for.
  for (let i = 0; chart.figure.map && i < 2; ++i) setRange(chart, squared(chart, ranges));
}

/// The ranges behind a rectangle of pixels, on whatever scale.
function behind(chart, left, top, right, bottom) {
  const { x, y } = chart.scales;
  return {
    x: [x.getValueForPixel(left), x.getValueForPixel(right)],
    y: [y.getValueForPixel(bottom), y.getValueForPixel(top)],
  };
}

function zoom(chart, factor, at, shift = { x: 0, y: 0 }) {
  const { left, top, right, bottom } = chart.chartArea;
  const place = (edge, centre, moved) => centre + (edge - centre) / factor - moved;
  show(chart, behind(chart, place(left, at.x, shift.x), place(top, at.y, shift.y), place(right, at.x, shift.x),
    place(bottom, at.y, shift.y)));
}

function reset(chart) {
  if (chart.figure.map) return show(chart, chart.whole);
  const own = scale(chart.figure, "x");
  Object.assign(chart.options.scales.x, { min: own.min, max: own.max });
  Object.assign(chart.options.scales.y, { min: undefined, max: undefined });
  chart.update("none");
}

/// All that a map shows, and a little more.
function extent(figure) {
  const range = (axis) => {
    let low = Infinity;
    let high = -Infinity;
    const solids = figure.areas.filter((shape) => shape.solid);
    for (const curve of [...figure.curves, ...solids, figure.discs]) {
      for (const value of curve[axis]) {
        if (value === null) continue;
        low = Math.min(low, value);
        high = Math.max(high, value);
      }
    }
    const margin = 0.03 * (high - low) || 1;
    return [low - margin, high + margin];
  };
  return { x: range("x"), y: range("y") };
}

const centre = ({ left, top, width, height }) => ({ x: left + width / 2, y: top + height / 2 });

function addTools(chart, holder) {
  const tools = document.createElement("div");
  tools.className = "tools";
  const button = (text, label, action) => {
    const made = document.createElement("button");
    Object.assign(made, { type: "button", textContent: text, title: label, ariaLabel: label, onclick: action });
    tools.append(made);
  };
  button("+", "Closer", () => zoom(chart, 1.6, centre(chart.chartArea)));
  button("−", "Farther", () => zoom(chart, 1 / 1.6, centre(chart.chartArea)));
  button("All", "All of it", () => reset(chart));
  holder.after(tools);
}

const isInside = ({ left, right, top, bottom }, { x, y }) => x >= left && x <= right && y >= top && y <= bottom;

function followMouse(chart, holder) {
  const canvas = chart.canvas;
  let from = null;
  let box = null;
  const place = (event) => {
    const frame = canvas.getBoundingClientRect();
    return { x: event.clientX - frame.left, y: event.clientY - frame.top };
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (event.pointerType !== "mouse" || event.button !== 0 || !isInside(chart.chartArea, place(event))) return;
    from = place(event);
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!from) return;
    const to = place(event);
    if (!box) holder.append((box = Object.assign(document.createElement("div"), { className: "box" })));
    Object.assign(box.style, {
      left: `${Math.min(from.x, to.x)}px`, top: `${Math.min(from.y, to.y)}px`,
      width: `${Math.abs(to.x - from.x)}px`, height: `${Math.abs(to.y - from.y)}px`,
    });
  });
  const end = (event) => {
    box?.remove();
    box = null;
    const to = place(event);
    const start = from;
    from = null;
    if (!start || Math.abs(to.x - start.x) < 6 || Math.abs(to.y - start.y) < 6) return;
    show(chart, behind(chart, Math.min(start.x, to.x), Math.min(start.y, to.y), Math.max(start.x, to.x),
      Math.max(start.y, to.y)));
  };
  canvas.addEventListener("pointerup", end);
  canvas.addEventListener("pointercancel", () => { box?.remove(); box = from = null; });
  canvas.addEventListener("dblclick", () => reset(chart));
  canvas.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && !event.metaKey) return;  // the page scrolls
    event.preventDefault();
    zoom(chart, Math.exp(-event.deltaY / 300), place(event));
  }, { passive: false });
}

/// Two fingers; one scrolls the page.
function followFingers(chart) {
  const canvas = chart.canvas;
  let last = null;
  const grip = (touches) => {
    const frame = canvas.getBoundingClientRect();
    const [a, b] = [0, 1].map((i) => ({ x: touches[i].clientX - frame.left, y: touches[i].clientY - frame.top }));
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.hypot(a.x - b.x, a.y - b.y) || 1 };
  };
  const follow = (event) => {
    if (event.touches.length !== 2) return (last = null);
    event.preventDefault();
    const now = grip(event.touches);
    if (last) zoom(chart, now.apart / last.apart, now, { x: now.x - last.x, y: now.y - last.y });
    last = now;
  };
  for (const name of ["touchstart", "touchmove", "touchend", "touchcancel"]) {
    canvas.addEventListener(name, follow, { passive: false });
  }
}

function draw(figure) {
  const holder = document.getElementById(figure.id);
  const canvas = document.createElement("canvas");
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", figure.title);
  holder.append(canvas);
  const chart = new Chart(canvas, {
    type: "scatter",
    data: { datasets: [] },
    plugins: [bands(figure), ground(figure)],
    options: {
      animation: false,
      maintainAspectRatio: false,
      interaction: { mode: "telling", intersect: false },
      plugins: { legend: legend(), tooltip: tooltip(figure) },
      scales: { x: scale(figure, "x"), y: scale(figure, "y") },
    },
  });
  chart.figure = figure;
  chart.data.datasets = figure.curves.map(dataset);
  colourise(chart);
  if (figure.map) chart.whole = extent(figure);
  reset(chart);
  if (figure.map) {
    const now = () => ({ x: [chart.scales.x.min, chart.scales.x.max], y: [chart.scales.y.min, chart.scales.y.max] });
    window.addEventListener("resize", () => setTimeout(() => show(chart, now()), 100));
  }
  addTools(chart, holder);
  followMouse(chart, holder);
  followFingers(chart);
  return chart;
}

function drawMatrix(matrix) {
  const canvas = document.getElementById(matrix.id);
  const cells = atob(matrix.cells);
  canvas.width = canvas.height = matrix.size;
  const context = canvas.getContext("2d");
  const image = context.createImageData(matrix.size, matrix.size);
  const [paper, ink] = dark.matches ? [[20, 24, 28], [228, 232, 235]] : [[255, 255, 255], [15, 26, 41]];
  for (let i = 0; i < cells.length; ++i) {
    const part = cells.charCodeAt(i) / 255;
    for (let k = 0; k < 3; ++k) image.data[4 * i + k] = paper[k] + (ink[k] - paper[k]) * part;
    image.data[4 * i + 3] = 255;
  }
  context.putImageData(image, 0, 0);
}

/// Shows at the edges of a wide table that it goes on there.
function hintAtMore(box) {
  const scroll = box.firstElementChild;
  const mark = () => {
    box.classList.toggle("more", scroll.scrollLeft + scroll.clientWidth < scroll.scrollWidth - 1);
    box.classList.toggle("moved", scroll.scrollLeft > 0);
  };
  scroll.addEventListener("scroll", mark, { passive: true });
  new ResizeObserver(mark).observe(scroll);
  mark();
}

const data = JSON.parse(document.getElementById("data").textContent);
Chart.defaults.font.family = getComputedStyle(document.body).fontFamily;
const charts = data.figures.map(draw);
data.matrices.forEach(drawMatrix);
document.querySelectorAll(".wide").forEach(hintAtMore);
dark.addEventListener("change", () => {
  for (const chart of charts) {
    colourise(chart);
    chart.update("none");
  }
  data.matrices.forEach(drawMatrix);
});
document.documentElement.dataset.drawn = String(charts.length + data.matrices.length);
