// The matrix of the watched estimator, and what a stage of an update does to it.

const matrix = { zoom: 1 };

on("matrix", (message) => {
  const canvas = byId("matrix");
  const size = message.size;
  canvas.width = canvas.height = size;
  const image = new ImageData(size, size);
  message.arrays.cells.forEach((darkness, i) => {
    image.data.set([255 - 0.94 * darkness, 255 - 0.9 * darkness, 255 - 0.84 * darkness, 255], 4 * i);
  });
  canvas.getContext("2d").putImageData(image, 0, 0);
  const watched = state.hello.estimators.find((estimator) => estimator.name === message.estimator);
  const kind = watched && watched.matrix === "covariance" ? "correlations" : "normalised information";
  byId("matrix-text").textContent = `${message.estimator}: ${kind}, ${short(100 * message.fill)} % of the blocks are not zero. First row: the robot.`;
});

function zoomMatrix(factor) {
  matrix.zoom = Math.min(16, Math.max(1, matrix.zoom * factor));
  byId("matrix").style.width = `${100 * matrix.zoom}%`;
}
byId("matrix-in").onclick = () => zoomMatrix(1.5);
byId("matrix-out").onclick = () => zoomMatrix(1 / 1.5);
byId("matrix-frame").addEventListener("wheel", (event) => {
  if (!event.ctrlKey) return;
  event.preventDefault();
  zoomMatrix(event.deltaY < 0 ? 1.2 : 1 / 1.2);
}, { passive: false });

// The stage.

const stageNames = { motion: "Motion", measurement: "Measurement", sparsification: "Sparsification", mean_recovery: "Mean recovery" };
const cellSize = 16;  // [px] of the canvas

function change(was, is) {
  if (was === 0 && is > 0) return "new";
  if (was > 0 && is === 0) return "gone";
  return was > 0 && Math.abs(is - was) > 0.01 * was ? "changed" : "";
}

function shade(strength) {
  const dark = strength <= 0 ? 0 : 0.12 + 0.88 * Math.sqrt(Math.sqrt(Math.min(1, strength)));
  return `rgb(${[0.94, 0.9, 0.84].map((full) => Math.round(255 * (1 - dark * full))).join(",")})`;
}

function drawHalf(canvas, values, stage, isAfter) {
  const rows = stage.ids.length + 1;
  canvas.width = canvas.height = rows * cellSize;
  const paint = canvas.getContext("2d");
  for (let i = 0; i < rows; ++i) {
    for (let j = 0; j < rows; ++j) {
      const k = i * rows + j;
      const what = i === j ? "" : change(stage.arrays.before[k], stage.arrays.after[k]);
      paint.fillStyle = shade(values[k]);
      if (what === "new" && isAfter) paint.fillStyle = "#5fd0a5";
      if (what === "gone") paint.fillStyle = isAfter ? "#ffe3d4" : "#ff9e6b";
      paint.fillRect(j * cellSize, i * cellSize, cellSize - 1, cellSize - 1);
      if (what !== "changed" || !isAfter) continue;
      paint.strokeStyle = "#0072b2";
      paint.lineWidth = 2;
      paint.strokeRect(j * cellSize + 1, i * cellSize + 1, cellSize - 3, cellSize - 3);
    }
  }
}

on("stage", (stage) => {
  byId("stage-part").hidden = false;
  byId("stage-part").open = true;
  byId("stage-name").textContent = `${stage.number} of ${stage.of}: ${stageNames[stage.stage]} (${stage.estimator}, ${stage.t.toFixed(2)} s)`;
  byId("sentence").textContent = stage.sentence;
  byId("equation").textContent = stage.equation;
  byId("cell").textContent = "Point at a cell: row and column, and its value before and after.";
  drawHalf(byId("before"), stage.arrays.before, stage, false);
  drawHalf(byId("after"), stage.arrays.after, stage, true);
});
on("hello", () => { byId("stage-part").hidden = true; });

const nameOfRow = (stage, row) => row === 0 ? "robot" : `landmark ${stage.ids[row - 1]}`;

/** The numbers of a block, row by row. */
function blockOf(values, stage, i, j) {
  const n = 3 + 2 * stage.ids.length;
  const first = (row) => row === 0 ? 0 : 1 + 2 * row;
  const size = (row) => row === 0 ? 3 : 2;
  const lines = [];
  for (let a = 0; a < size(i); ++a) {
    const line = [];
    for (let b = 0; b < size(j); ++b) line.push(short(values[(first(j) + b) * n + first(i) + a]));
    lines.push(line.join(" "));
  }
  return `[${lines.join("; ")}]`;
}

function showCell(event) {
  const stage = state.stage;
  if (!stage) return;
  const box = event.target.getBoundingClientRect();
  const rows = stage.ids.length + 1;
  const j = Math.min(rows - 1, Math.max(0, Math.floor((event.clientX - box.left) / box.width * rows)));
  const i = Math.min(rows - 1, Math.max(0, Math.floor((event.clientY - box.top) / box.height * rows)));
  const k = i * rows + j;
  let text = `${nameOfRow(stage, i)} – ${nameOfRow(stage, j)}: ${short(stage.arrays.before[k])} → ${short(stage.arrays.after[k])}`;
  if (stage.whole) text += `; block ${blockOf(stage.arrays.values_before, stage, i, j)} → ${blockOf(stage.arrays.values_after, stage, i, j)}`;
  byId("cell").textContent = text;
}
for (const id of ["before", "after"]) {
  byId(id).addEventListener("pointermove", showCell);
  byId(id).addEventListener("pointerdown", showCell);
}
