// The scoreboard as it stands, the layers, and the legend.

const columns = [["error [m]", "error_m"], ["RMSE [m]", "rmse_m"], ["3σ [m]", "three_sigma_m"], ["NEES", "nees"], ["NEES map", "nees_map"],
  ["p50 [µs]", "p50_us"], ["p99 [µs]", "p99_us"], ["links", "links"], ["landmarks", "landmarks"], ["memory [MB]", "memory_bytes"]];
const layerNames = ["grid", "rays", "range", "truth", "odometry", "estimate", "landmarks", "ellipses", "links", "active", "errors"];

function element(tag, text, attributes = {}) {
  const made = document.createElement(tag);
  if (text !== null) made.textContent = text;
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}

function swatch(colour) {
  const mark = element("span", "", { class: "swatch" });
  mark.style.background = colour;
  return mark;
}

function makeBoard(hello) {
  const head = element("tr", null);
  head.append(element("th", "shown", { scope: "col" }), ...columns.map(([title]) => element("th", title, { scope: "col" })));
  const rows = hello.estimators.map((estimator, i) => {
    const row = element("tr", null);
    const cell = element("td", null);
    const label = element("label", null);
    const box = element("input", null, { type: "checkbox" });
    box.checked = state.shown[i];
    box.onchange = () => { state.shown[i] = box.checked; charts.isStale = view.isDirty = true; };
    label.append(box, " ", swatch(estimator.colour), estimator.name);
    cell.append(label);
    row.append(cell, ...columns.map(() => element("td", "–")));
    return row;
  });
  byId("board").replaceChildren(head, ...rows);
  byId("watch").replaceChildren(...hello.estimators.map(({ name }) => element("option", name, { value: name })));
}

let lastBoard = 0;
on("frame", (frame) => {
  const now = performance.now();
  if (now - lastBoard < 200 && frame.state === "running") return;
  lastBoard = now;
  if (document.activeElement !== byId("watch")) byId("watch").value = frame.watched;
  frame.estimators.forEach((estimator, i) => {
    const cells = byId("board").rows[i + 1].cells;
    if (estimator.failure) {
      cells[1].textContent = "failed";
      cells[1].title = estimator.failure;
      return;
    }
    columns.forEach(([, key], k) => {
      const value = key === "memory_bytes" ? estimator[key] / 1e6 || null : estimator[key];
      cells[k + 1].textContent = short(value);
    });
  });
});

function makeLayers() {
  byId("layers").replaceChildren(...layerNames.map((name, i) => {
    const button = element("button", i < 9 ? `${i + 1} ${name}` : name, { "aria-pressed": String(Boolean(state.layers[name])), "data-layer": name });
    button.onclick = () => toggleLayer(name);
    return button;
  }));
}

function toggleLayer(name) {
  state.layers[name] = !state.layers[name];
  document.querySelector(`[data-layer=${name}]`).setAttribute("aria-pressed", String(state.layers[name]));
  view.isDirty = true;
  tellView();
}

function makeLegend({ colours, estimators }) {
  const entries = [[colours.truth, "the robot's true path"], [colours.odometry, "its path by odometry alone"], [colours.post, "true landmarks"],
    ...estimators.map(({ colour, name }) => [colour, `${name}: path, pose, landmarks, ellipses of two sigma`]),
    [colours.orange, "active landmarks, and their links to the robot"], [colours.link, "links between landmarks"],
    [colours.purple, "errors: from an estimate to the truth; rays of false detections"], [colours.sky_blue, "rays of the latest scan, and the sensor's range"],
    [colours.hidden_ray, "rays to landmarks that something hides"]];
  byId("legend").replaceChildren(...entries.map(([colour, words]) => {
    const line = element("li", null);
    line.append(swatch(colour), words);
    return line;
  }));
}

on("hello", (hello) => {
  byId("name").textContent = hello.name;
  document.title = `${hello.name} – seifbed live`;
  makeBoard(hello);
  makeLayers();
  makeLegend(hello);
});
byId("watch").onchange = () => wire.send({ do: "watch", estimator: byId("watch").value });
byId("side").onchange = () => { if (view.mode === "overview") overview(); view.controls.update(); view.isDirty = true; };
