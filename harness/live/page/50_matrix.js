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
const cellSize = 24;  // [px] of the canvas

function change(was, is) {
  if (was === 0 && is > 0) return "new";
  if (was > 0 && is === 0) return "gone";
  return was > 0 && Math.abs(is - was) > 0.01 * was ? "changed" : "";
}

function shade(strength) {
  const dark = strength <= 0 ? 0 : 0.12 + 0.88 * Math.sqrt(Math.sqrt(Math.min(1, strength)));
  return `rgb(${[0.94, 0.9, 0.84].map((full) => Math.round(255 * (1 - dark * full))).join(",")})`;
}

/** The names of the rows, above and at the left: r is the robot. */
function drawNames(paint, stage) {
  paint.fillStyle = "#444c55";
  paint.font = `${0.6 * cellSize}px sans-serif`;
  paint.textAlign = "center";
  paint.textBaseline = "middle";
  for (let row = 0; row <= stage.ids.length; ++row) {
    const name = row === 0 ? "r" : String(stage.ids[row - 1]);
    paint.fillText(name, 0.5 * cellSize, (row + 1.5) * cellSize, cellSize);
    paint.fillText(name, (row + 1.5) * cellSize, 0.5 * cellSize, cellSize);
  }
}

function drawHalf(canvas, values, stage, isAfter) {
  const rows = stage.ids.length + 1;
  canvas.width = canvas.height = (rows + 1) * cellSize;
  const paint = canvas.getContext("2d");
  drawNames(paint, stage);
  for (let i = 0; i < rows; ++i) {
    for (let j = 0; j < rows; ++j) {
      const k = i * rows + j;
      const x = (j + 1) * cellSize, y = (i + 1) * cellSize;
      const what = i === j ? "" : change(stage.arrays.before[k], stage.arrays.after[k]);
      paint.fillStyle = shade(values[k]);
      if (what === "new" && isAfter) paint.fillStyle = "#5fd0a5";
      if (what === "gone") paint.fillStyle = isAfter ? "#ffe3d4" : "#ff9e6b";
      paint.fillRect(x, y, cellSize - 1, cellSize - 1);
      if (what !== "changed" || !isAfter) continue;
      paint.strokeStyle = "#0072b2";
      paint.lineWidth = 2;
      paint.strokeRect(x + 1, y + 1, cellSize - 3, cellSize - 3);
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
  const cell = (share) => Math.min(rows - 1, Math.max(0, Math.floor(share * (rows + 1)) - 1));
  const j = cell((event.clientX - box.left) / box.width);
  const i = cell((event.clientY - box.top) / box.height);
  const k = i * rows + j;
  let text = `${nameOfRow(stage, i)} – ${nameOfRow(stage, j)}: ${short(stage.arrays.before[k])} → ${short(stage.arrays.after[k])}`;
  if (stage.whole) text += `; block ${blockOf(stage.arrays.values_before, stage, i, j)} → ${blockOf(stage.arrays.values_after, stage, i, j)}`;
  byId("cell").textContent = text;
}
for (const id of ["before", "after"]) {
  byId(id).addEventListener("pointermove", showCell);
  byId(id).addEventListener("pointerdown", showCell);
}
