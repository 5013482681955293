// A landmark that was clicked.

const clickReach = 14;  // [px]

let pressedAt = null;
byId("scene").addEventListener("pointerdown", (event) => { pressedAt = [event.clientX, event.clientY]; });
byId("scene").addEventListener("click", (event) => {
  if (hands.mode && hands.mode !== "drive") return;
  if (!pressedAt || Math.hypot(event.clientX - pressedAt[0], event.clientY - pressedAt[1]) > 4) return;
  const found = nearestLandmark(event);
  if (found) wire.send({ do: "inspect", estimator: state.hello.estimators[found.index].name, id: found.id });
});

/** The mean that is nearest to a point of the screen, among the shown estimators; the watched one first. */
function nearestLandmark(event) {
  const p = groundAt(event.clientX, event.clientY);
  if (!p || !state.frame) return null;
  const beside = groundAt(event.clientX + clickReach, event.clientY);
  const reach = beside ? p.distanceTo(beside) : 0.5;
  const order = [watchedIndex(), ...state.beliefs.map((_, i) => i)].filter((i) => i >= 0 && state.shown[i]);
  for (const index of order) {
    const belief = state.beliefs[index];
    let best = null, least = reach;
    for (let k = 0; k < belief.ids.length; ++k) {
      const distance = Math.hypot(belief.dots.values[3 * k] - p.x, belief.dots.values[3 * k + 1] - p.y);
      if (distance < least) { least = distance; best = belief.ids[k]; }
    }
    if (best !== null) return { index, id: best };
  }
  return null;
}

function fillTable(table, head, rows) {
  const headRow = element("tr", null);
  headRow.append(...head.map((title) => element("th", title, { scope: "col" })));
  table.replaceChildren(headRow, ...rows.map((values) => {
    const row = element("tr", null);
    row.append(...values.map((value) => element("td", value)));
    return row;
  }));
}

on("landmark", (message) => {
  byId("landmark-part").open = true;
  byId("landmark-hint").textContent = `Landmark ${message.id} of ${message.estimator}, seen ${message.seen} times`;
  const facts = [["mean [m]", message.mean.map((value) => value.toFixed(3)).join(", ")]];
  if (message.truth) {
    facts.push(["truth [m]", message.truth.map((value) => value.toFixed(3)).join(", ")]);
    facts.push(["error [m]", short(Math.hypot(message.mean[0] - message.truth[0], message.mean[1] - message.truth[1]))]);
  }
  if (message.covariance) facts.push(["standard deviations [m]", `${short(Math.sqrt(message.covariance[0]))}, ${short(Math.sqrt(message.covariance[2]))}`]);
  facts.push(["NEES", short(message.nees)]);
  byId("landmark-facts").replaceChildren(...facts.flatMap(([name, value]) => [element("dt", name), element("dd", value)]));
  const correlations = new Map(message.correlations);
  fillTable(byId("landmark-links"), ["linked to", "strength", "correlation"], message.links.map(([id, strength]) =>
    [id < 0 ? "robot" : `landmark ${id}`, short(strength), short(correlations.get(id))]));
  fillTable(byId("landmark-seen"), ["seen at [s]", "range [m]", "bearing [°]"], message.observations.map((seen) =>
    [seen.t.toFixed(2), seen.range_m.toFixed(3), (seen.bearing_rad * 180 / Math.PI).toFixed(2)]).reverse());
  const belief = state.beliefs[state.hello.estimators.findIndex(({ name }) => name === message.estimator)];
  if (belief && message.covariance) {
    belief.covs.set(message.id, Float32Array.from(message.covariance));
    belief.isStale = true;
  }
});
