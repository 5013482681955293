// What the page knows of the run.

const state = {
  connected: false,
  recorded: false,   // the page plays what was seen, without the program
  hello: null,
  epoch: -1,
  t: 0,
  state: "connecting",
  frame: null,       // the latest
  frames: 0,         // received
  beliefs: [],       // of each estimator: what the scene draws
  shown: [],         // of each estimator: whether it is shown
  layers: {},
  stage: null,       // the latest
  said: null,
  saved: null,
  landmark: null,
  firstPicture: null,  // [ms] after the page was opened
  scriptMs: 0,         // [ms] that the latest frame cost the page's own script
};

const byId = (id) => document.getElementById(id);

/** Something that looks at each message of a kind, in the order in which it was added. */
const listeners = {};
function on(kind, listener) { (listeners[kind] = listeners[kind] || []).push(listener); }
function tellAll(message) { for (const listener of listeners[message.kind] || []) listener(message); }

function watchedIndex() {
  const name = state.frame ? state.frame.watched : "";
  return state.hello ? state.hello.estimators.findIndex((estimator) => estimator.name === name) : -1;
}

on("hello", (message) => {
  state.hello = message;
  state.epoch = message.epoch;
  state.frame = state.stage = state.landmark = null;
  if (state.shown.length !== message.estimators.length)
    state.shown = message.estimators.map((estimator, i) => i < 2);
  if (Object.keys(state.layers).length === 0) state.layers = message.layers;
});
on("frame", (message) => {
  state.frame = message;
  state.t = message.t;
  state.state = message.state;
  ++state.frames;
});
for (const kind of ["stage", "said", "saved", "landmark"]) on(kind, (message) => { state[kind] = message; });

/** A number in few digits. */
function short(value, digits = 3) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (value !== 0 && (Math.abs(value) >= 1e5 || Math.abs(value) < 1e-3)) return value.toExponential(1);
  return Number(value.toPrecision(digits)).toString();
}

function toast(text, isError) {
  const line = document.createElement("p");
  line.textContent = text;
  line.className = isError ? "error" : "";
  byId("toast").append(line);
  while (byId("toast").children.length > 3) byId("toast").firstChild.remove();
  setTimeout(() => line.remove(), isError ? 9000 : 5000);
}
on("said", (message) => toast(message.text, message.level === "error"));
