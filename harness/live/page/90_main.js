// Brings everything together.

const msBetweenViews = 250;

/** Takes in a message. */
function take(buffer) {
  const begin = performance.now();
  const message = decode(buffer);
  if (!state.recorded) keep(message.kind, buffer);
  if (message.kind !== "frame" || message.epoch === state.epoch) tellAll(message);
  if (message.kind === "frame") state.scriptMs = performance.now() - begin;
}

/** Tells the program which part of the ground is in view, and what else is wanted. */
let toldView = "", lastView = 0;
function tellView() {
  if (!state.hello || state.recorded) return;
  const middle = view.controls.target;
  const reach = Math.min(2000, Math.max(10, 0.9 * view.camera.position.distanceTo(middle)));
  const wanted = {
    do: "view", min: [Math.round(middle.x - reach), Math.round(middle.y - reach)], max: [Math.round(middle.x + reach), Math.round(middle.y + reach)],
    matrix: byId("matrix-part").open, links: Boolean(state.layers.links),
  };
  const text = JSON.stringify(wanted);
  if (text === toldView) return;
  if (wire.send(wanted) > 0) toldView = text;
}

let lastTime = 0;
function loop(now) {
  requestAnimationFrame(loop);
  if (state.recorded) player.tick(now - lastTime);
  lastTime = now;
  readGamepad(now);
  view.controls.update();
  if (refreshSlowMarks(now)) view.isDirty = true;
  refreshCharts(now);
  if (now - lastView > msBetweenViews) {
    lastView = now;
    tellView();
  }
  if (view.isDirty && state.hello) render();
}

function start() {
  startView();
  resize();
  const recorded = byId("recorded");
  if (recorded) {
    state.recorded = true;
    player.load(recorded.textContent);
    byId("play").onclick = () => player.toggle();
    player.seek(0);
    player.isPlaying = !calm;
  } else {
    wire.receive = take;
    wire.changed = () => {
      state.connected = wire.isOpen();
      toldView = "";
      if (state.connected) state.epoch = -1;
      showState();
    };
    wire.connect();
  }
  window.seifbed = { state, view, world, player, record, send: (request) => wire.send(request), page: pageOfWhatWasSeen };
  requestAnimationFrame(loop);
}
start();
