// Taking hold of the run: driving, moving the robot, things put into the world, options.

const hands = { mode: null, pressed: new Set(), told: "", from: null };
const modeWords = {
  drive: "W A S D or arrows drive; Esc leaves. The robot stays in your hands until you give the wheel back.",
  kidnap: "Drag the robot to another place. Nothing tells the estimators.",
  ice: "Drag a rectangle: its friction becomes 0.02.",
  wall: "Drag a line: a wall appears.",
  landmark: "Click: a landmark appears.",
};
const speeds = { v: 0.8, omega: 1.2 };  // [m/s] [rad/s] at full deflection

function setMode(mode) {
  if (hands.mode === "drive" && mode !== "drive") stopDriving();
  hands.mode = hands.mode === mode ? null : mode;
  hands.from = null;
  view.controls.enabled = hands.mode === null || hands.mode === "drive";
  for (const button of document.querySelectorAll("[data-mode]"))
    button.setAttribute("aria-pressed", String(button.dataset.mode === hands.mode));
  byId("mode").hidden = hands.mode === null;
  byId("mode").textContent = hands.mode ? modeWords[hands.mode] : "";
}
for (const button of document.querySelectorAll("[data-mode]")) button.onclick = () => setMode(button.dataset.mode);

// Driving.

const driveKeys = { w: [1, 0], arrowup: [1, 0], s: [-1, 0], arrowdown: [-1, 0], a: [0, 1], arrowleft: [0, 1], d: [0, -1], arrowright: [0, -1] };

function driveKey(event, isDown) {
  const key = event.key.toLowerCase();
  if (!driveKeys[key]) return false;
  event.preventDefault();
  if (isDown) hands.pressed.add(key); else hands.pressed.delete(key);
  let v = 0, omega = 0;
  for (const pressed of hands.pressed) { v += driveKeys[pressed][0]; omega += driveKeys[pressed][1]; }
  drive(Math.sign(v), Math.sign(omega));
  return true;
}

function drive(v, omega) {
  const command = { do: "drive", v: Number((speeds.v * v).toFixed(3)), omega: Number((speeds.omega * omega).toFixed(3)) };
  const text = JSON.stringify(command);
  if (text === hands.told) return;
  hands.told = text;
  wire.send(command);
}
function stopDriving() {
  hands.pressed.clear();
  if (hands.told !== "") drive(0, 0);
  hands.told = "";
}
window.addEventListener("blur", () => { if (hands.mode === "drive") stopDriving(); });
byId("release").onclick = () => {
  if (hands.mode === "drive") setMode(null);
  wire.send({ do: "release" });
};

let lastGamepad = 0;
/** The left stick, at most ten times a second. */
function readGamepad(now) {
  if (hands.mode !== "drive" || !navigator.getGamepads || now - lastGamepad < 100) return;
  const pad = [...navigator.getGamepads()].find((one) => one);
  if (!pad) return;
  lastGamepad = now;
  const dead = (value) => (Math.abs(value) < 0.12 ? 0 : value);
  if (hands.pressed.size === 0) drive(-dead(pad.axes[1]), -dead(pad.axes[0]));
}

// In the scene.

const round = (p) => [Number(p.x.toFixed(3)), Number(p.y.toFixed(3))];

function pointerDown(event) {
  if (!hands.mode || hands.mode === "drive" || event.button !== 0) return;
  hands.from = groundAt(event.clientX, event.clientY);
  if (hands.from) byId("scene").setPointerCapture(event.pointerId);
  if (hands.mode === "kidnap") showGhost(hands.from);
}
function showGhost(p) {
  world.ghost.visible = p !== null;
  if (p) world.ghost.position.set(p.x, p.y, 0.05);
  view.isDirty = true;
}
function pointerMove(event) {
  if (hands.from && hands.mode === "kidnap") showGhost(groundAt(event.clientX, event.clientY));
}
function pointerUp(event) {
  if (!hands.from) return;
  const from = hands.from, to = groundAt(event.clientX, event.clientY);
  hands.from = null;
  showGhost(null);
  if (!to) return;
  const [x, y] = round(to);
  if (hands.mode === "kidnap") wire.send({ do: "kidnap", x, y, heading_deg: Number((view.heading * 180 / Math.PI).toFixed(2)) });
  if (hands.mode === "landmark") wire.send({ do: "landmark", x, y });
  if (hands.mode === "wall" && from.distanceTo(to) > 0.2) wire.send({ do: "wall", points: [round(from), [x, y]] });
  if (hands.mode === "ice" && Math.abs(to.x - from.x) > 0.1 && Math.abs(to.y - from.y) > 0.1) {
    const [a, b] = [round(from), [x, y]];
    wire.send({ do: "ice", min: [Math.min(a[0], b[0]), Math.min(a[1], b[1])], max: [Math.max(a[0], b[0]), Math.max(a[1], b[1])], friction: 0.02 });
  }
}
byId("scene").addEventListener("pointerdown", pointerDown);
byId("scene").addEventListener("pointermove", pointerMove);
byId("scene").addEventListener("pointerup", pointerUp);

// Sensors and options.

byId("blind").onchange = () => wire.send({ do: "silence", sensor: "landmark_sensor", on: byId("blind").checked });
byId("numb").onchange = () => wire.send({ do: "silence", sensor: "encoders", on: byId("numb").checked });
byId("outlier").onclick = () => wire.send({ do: "outlier", size_sigma: Number(byId("sigmas").value) });
byId("again").onclick = () => wire.send({ do: "again" });

function optionsOf(estimator) {
  const factor = (key, words) => ({ key, value: estimator[key], changeable: true, help: `The noise of the ${words} that the estimator assumes, over that of the data [-].` });
  return [...estimator.options, factor("odometry_sd_factor", "odometry"), factor("observation_sd_factor", "observations")];
}
function chosenEstimator() { return state.hello.estimators.find(({ name }) => name === byId("whose").value); }
function chosenOption() { return optionsOf(chosenEstimator()).find(({ key }) => key === byId("which").value); }

function fillOptions() {
  const options = optionsOf(chosenEstimator());
  options.sort((a, b) => Number(b.changeable) - Number(a.changeable));
  byId("which").replaceChildren(...options.map(({ key }) => element("option", key, { value: key })));
  fillValue();
}
function fillValue() {
  const option = chosenOption();
  byId("what").value = String(option.value);
  byId("option-help").textContent = option.help + (option.choices ? ` One of: ${option.choices.join(", ")}.` : "") +
    (option.changeable ? "" : " It cannot change during a run; a copy beside can have another value.");
  byId("change").disabled = !option.changeable || !state.hello.can.options;
}
byId("whose").onchange = fillOptions;
byId("which").onchange = fillValue;

function wantedValue() {
  const text = byId("what").value.trim();
  if (text === "true" || text === "false") return text === "true";
  return text !== "" && !Number.isNaN(Number(text)) ? Number(text) : text;
}
for (const [id, what] of [["change", "option"], ["beside", "beside"]])
  byId(id).onclick = () => wire.send({ do: what, estimator: byId("whose").value, option: byId("which").value, value: wantedValue() });

on("hello", (hello) => {
  setMode(null);
  byId("whose").replaceChildren(...hello.estimators.map(({ name }) => element("option", name, { value: name })));
  const ours = hello.estimators.find(({ type }) => type === "seif");
  if (ours) byId("whose").value = ours.name;
  if (hello.estimators.length > 0) fillOptions();
  const { can } = hello;
  byId("why-not").textContent = hello.why_not;
  byId("why-not").hidden = can.world;
  for (const node of document.querySelectorAll("[data-mode], #release, #blind, #numb, #outlier")) node.disabled = !can.world;
  byId("again").disabled = byId("beside").disabled = !can.control;
  for (const node of document.querySelectorAll("[data-save]")) node.disabled = !can.save;
});
on("frame", (frame) => {
  for (const [id, sensor] of [["blind", "landmark_sensor"], ["numb", "encoders"]])
    if (document.activeElement !== byId(id)) byId(id).checked = frame.silent.includes(sensor);
});
