// Going on, stopping, stepping, and going back.

const words = { running: "running", paused: "stopped", stage: "in the middle of an update", ended: "at the end", rewinding: "simulated again" };

/** Speeds from 0.1 to 100 in equal steps of their logarithm; the last one is as fast as it goes. */
function speedAt(step) { return step > 20 ? "max" : Number((10 ** (step / 10)).toPrecision(2)); }

function pauseOrGo() { wire.send({ do: state.state === "running" ? "pause" : "go" }); }

byId("play").onclick = pauseOrGo;
for (const button of document.querySelectorAll("[data-do]")) button.onclick = () => wire.send({ do: button.dataset.do });

byId("speed").oninput = () => {
  const value = speedAt(Number(byId("speed").value));
  wire.send({ do: "speed", value });
  showSpeed(value);
};
function changeSpeed(by) {
  byId("speed").value = String(Number(byId("speed").value) + by);
  byId("speed").oninput();
}
function showSpeed(value) {
  const text = value === "max" ? "as fast as it goes" : `${value}×`;
  byId("speed-text").textContent = text;
  byId("speed").setAttribute("aria-valuetext", text);
}

let isDraggingTime = false;
byId("time").oninput = () => { isDraggingTime = true; byId("time-text").textContent = `${Number(byId("time").value).toFixed(1)} s`; };
byId("time").onchange = () => {
  isDraggingTime = false;
  if (state.recorded) return player.seek(Number(byId("time").value));
  if (Number(byId("time").value) < state.t) wire.send({ do: "back", t: Number(byId("time").value) });
};

function showState() {
  const isKnown = words[state.state] !== undefined;
  let text = isKnown ? words[state.state] : state.state;
  if (state.recorded) text = player.isPlaying ? "recorded, playing" : "recorded";
  else if (!state.connected) text = state.hello ? "the program has ended" : "connecting";
  else if (state.state === "rewinding") text += ` ${Math.round(100 * state.frame.progress)} %`;
  if (byId("state").textContent !== text) byId("state").textContent = text;
  const plays = state.recorded ? player.isPlaying : state.state === "running";
  byId("play").textContent = plays ? "Stop" : "Go";
  const can = state.hello ? state.hello.can : {};
  for (const button of document.querySelectorAll("#controls button[data-do], #speed")) button.disabled = state.recorded || !can.control;
  byId("play").disabled = !state.recorded && !can.control;
  byId("time").disabled = !state.recorded && !can.back;
}

on("hello", (hello) => {
  byId("time").min = String(hello.start_t);
  byId("time").max = String(hello.duration_s ? hello.start_t + hello.duration_s : hello.start_t + 1);
  showState();
});
on("frame", (frame) => {
  if (frame.t > Number(byId("time").max)) byId("time").max = String(frame.t);
  if (!isDraggingTime) {
    byId("time").value = String(frame.t);
    byId("time-text").textContent = `${frame.t.toFixed(frame.state === "running" ? 1 : 3)} s`;
  }
  if (document.activeElement !== byId("speed")) {
    byId("speed").value = String(frame.speed === "max" ? 21 : Math.round(10 * Math.log10(frame.speed)));
    showSpeed(frame.speed);
  }
  const measured = frame.state === "running" && frame.realtime > 0 ? `, ${short(frame.realtime, 2)} times real time` : "";
  const pages = frame.viewers > 1 ? `, ${frame.viewers} pages` : "";
  byId("facts").textContent = `seed ${state.hello.seed}, update ${frame.updates}, step ${frame.step}${measured}${pages}`;
  showState();
});

// Keys.

const keys = [["Space", "stop, or go on"], ["N", "one step of the physics"], ["U", "to the end of the next update"], ["S", "to the end of the next stage of an update"],
  ["+ −", "faster, slower"], ["W A S D, arrows", "drive, after “Drive by hand”"], ["1 to 9", "show or hide a layer"], ["Esc", "leave a mode"], ["?", "this help"]];
byId("keys").replaceChildren(...keys.flatMap(([key, what]) => {
  const name = element("dt", null);
  name.append(element("kbd", key));
  return [name, element("dd", what)];
}));
byId("help-button").onclick = () => byId("help").showModal();

function isTyping(target) { return ["INPUT", "SELECT", "TEXTAREA"].includes(target.tagName) && target.type !== "checkbox" && target.type !== "range"; }

const actions = {
  " ": () => (state.recorded ? player.toggle() : pauseOrGo()),
  n: () => wire.send({ do: "step" }), u: () => wire.send({ do: "update" }), s: () => wire.send({ do: "stage" }),
  "+": () => changeSpeed(1), "=": () => changeSpeed(1), "-": () => changeSpeed(-1),
  "?": () => byId("help").showModal(), Escape: () => setMode(null),
};

document.addEventListener("keydown", (event) => {
  if (isTyping(event.target) || event.ctrlKey || event.metaKey || event.altKey) return;
  if (hands.mode === "drive" && driveKey(event, true)) return;
  if (event.key === " " && event.target.tagName === "BUTTON") return;  // it presses the button
  const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
  if (key >= "1" && key <= "9") toggleLayer(layerNames[Number(key) - 1]);
  else if (actions[key]) actions[key]();
  else return;
  event.preventDefault();
});
document.addEventListener("keyup", (event) => { if (hands.mode === "drive") driveKey(event, false); });
