// What the estimators believe, over the world.

const common = { group: new THREE.Group(), truth: null, odometry: null, rays: null, range: null };
view.scene.add(common.group);

const rayColours = {};
const secondsBetweenSlowMarks = 0.2;
const smallestEllipse = 3;  // [px] its half axis

function makeBelief(estimator) {
  const colour = new THREE.Color(estimator.colour);
  const colours = state.hello.colours;
  const belief = {
    group: new THREE.Group(), colour, ids: [], numbers: new Map(), covs: new Map(), active: [], links: [], weights: [],
    dots: new Dots(colour, 6), activeDots: new Dots(new THREE.Color(colours.orange), 11), trail: new Trail(colour, 3),
    ellipses: new Ellipses(colour), lines: new Lines(4000, 0.5, 2), activeLines: new Lines(1200, 0.9, 2),
    errors: new Lines(1200, 0.9, 2), arrow: makeArrow(colour), history: [], isStale: true, pose: null,
  };
  for (const part of [belief.ellipses, belief.lines, belief.activeLines, belief.errors, belief.trail, belief.activeDots, belief.dots])
    belief.group.add(part.object);
  belief.group.add(belief.arrow);
  view.scene.add(belief.group);
  return belief;
}

/** An arrowhead half a metre long, where the estimate is. */
function makeArrow(colour) {
  const shape = new THREE.Shape();
  shape.moveTo(0.4, 0);
  shape.lineTo(-0.25, 0.26);
  shape.lineTo(-0.08, 0);
  shape.lineTo(-0.25, -0.26);
  const arrow = new THREE.Mesh(new THREE.ShapeBufferGeometry(shape), new THREE.MeshBasicMaterial({ color: colour, depthTest: false, transparent: true, side: THREE.DoubleSide }));
  arrow.position.z = above;
  arrow.renderOrder = 4;
  return arrow;
}

on("hello", (hello) => {
  for (const belief of state.beliefs) view.scene.remove(belief.group);
  clearGroup(common.group);
  state.beliefs = hello.estimators.map(makeBelief);
  common.truth = new Trail(hello.colours.truth, 2);
  common.odometry = new Trail(hello.colours.odometry, 2);
  common.rays = new Lines(300, 0.85, 2);
  ["sky_blue", "hidden_ray", "purple"].forEach((name, i) => { rayColours[i] = new THREE.Color(hello.colours[name]); });
  common.range = makeRange(hello.sensor, hello.colours.sky_blue);
  common.group.add(common.truth.object, common.odometry.object, common.rays.object, common.range);
});

function makeRange(sensor, colour) {
  const radius = sensor.range_m || 0.001;
  const geometry = new THREE.CircleBufferGeometry(radius, 64, -0.5 * sensor.fov_rad, sensor.fov_rad);
  const range = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ color: colour, transparent: true, opacity: 0.1, depthWrite: false }));
  range.position.z = 0.01;
  return range;
}

on("trails", ({ arrays }) => {
  common.truth.append(arrays.truth);
  common.odometry.append(arrays.odometry);
  state.beliefs.forEach((belief, i) => belief.trail.append(arrays[`estimate${i}`]));
});

function takeTrail(frame, trail, name) {
  const points = frame.arrays[`trail_${name}`];
  if (!points) return;
  if (frame.whole_trails.includes(name)) trail.clear();
  trail.append(points);
}

function takeBelief(belief, i, frame) {
  const arrays = frame.arrays;
  belief.pose = frame.estimators[i].pose;
  belief.covariance = frame.estimators[i].covariance;
  const means = arrays[`means${i}`];
  arrays[`ids${i}`].forEach((id, k) => {
    let number = belief.numbers.get(id);
    if (number === undefined) {
      number = belief.ids.length;
      belief.numbers.set(id, number);
      belief.ids.push(id);
    }
    belief.dots.put(number, means[2 * k], means[2 * k + 1]);
  });
  const covs = arrays[`covs${i}`];
  arrays[`covids${i}`].forEach((id, k) => belief.covs.set(id, covs.slice(3 * k, 3 * k + 3)));
  belief.active = arrays[`active${i}`];
  if (arrays[`links${i}`]) {
    belief.links = arrays[`links${i}`].slice();
    belief.weights = arrays[`weights${i}`].slice();
  }
  belief.arrow.position.set(belief.pose[0], belief.pose[1], above);
  belief.arrow.rotation.z = belief.pose[2];
  belief.dots.commit();
  belief.isStale = true;
}

/** The mean of a landmark; null if it is not known. */
function meanOf(belief, id) {
  const number = belief.numbers.get(id);
  return number === undefined ? null : belief.dots.values.subarray(3 * number, 3 * number + 2);
}

const orange = new THREE.Color(0xe69f00), purple = new THREE.Color(0xcc79a7);
const newLink = new THREE.Color(0x009e73), goneLink = new THREE.Color(0xd55e00);

/** Links to the robot: few, and new with each frame. In a stage, what is new and what is gone has a colour of its own. */
function drawActive(belief, i) {
  belief.activeDots.clear();
  belief.activeLines.clear();
  const stage = state.state === "stage" && state.stage && state.hello.estimators[i].name === state.stage.estimator && state.hello.estimators[i].matrix === "information" ? state.stage : null;
  belief.active.forEach((id) => {
    const mean = meanOf(belief, id);
    if (!mean) return;
    belief.activeDots.put(belief.activeDots.count, mean[0], mean[1]);
    if (!stage) belief.activeLines.add(belief.pose[0], belief.pose[1], mean[0], mean[1], orange);
  });
  if (stage) drawStageLinks(belief, stage);
  belief.activeDots.commit();
  belief.activeLines.commit();
}

function drawStageLinks(belief, stage) {
  const rows = stage.ids.length + 1;
  const place = (row) => row === 0 ? belief.pose : meanOf(belief, stage.ids[row - 1]) || truePlace(stage.ids[row - 1]);
  for (let a = 0; a < rows; ++a) {
    for (let b = 0; b < a; ++b) {
      const was = stage.arrays.before[a * rows + b], is = stage.arrays.after[a * rows + b];
      const stays = was > 0 && is > 0;
      if ((was === 0 && is === 0) || (stays && b > 0)) continue;
      const from = place(a), to = place(b);
      if (!from || !to) continue;
      const colour = stays ? orange : was === 0 ? newLink : goneLink;
      belief.activeLines.add(from[0], from[1], to[0], to[1], colour);
    }
  }
}

/** Ellipses, errors and links: many, and drawn again a few times a second. */
function drawSlowMarks(belief, i) {
  belief.ellipses.clear();
  belief.errors.clear();
  belief.lines.clear();
  const middle = view.controls.target;
  const reach = 1.4 * view.camera.position.distanceTo(middle);
  const least = (smallestEllipse / metreAt(middle)) ** 2;  // [m^2] what is smaller hides behind its dot
  for (const [id, cov] of belief.covs) {
    const mean = meanOf(belief, id);
    if (!mean || 4 * (cov[0] + cov[2]) < least || Math.hypot(mean[0] - middle.x, mean[1] - middle.y) > reach) continue;
    belief.ellipses.add(mean[0], mean[1], cov[0], cov[1], cov[2]);
  }
  if (belief.covariance) belief.ellipses.add(belief.pose[0], belief.pose[1], belief.covariance[0], belief.covariance[1], belief.covariance[4]);
  const step = Math.max(1, Math.ceil(belief.ids.length / 4000));
  for (let k = 0; k < belief.ids.length; k += step) {
    const x = belief.dots.values[3 * k], y = belief.dots.values[3 * k + 1];
    if (Math.hypot(x - middle.x, y - middle.y) > reach) continue;
    const truth = truePlace(belief.ids[k]);
    if (truth && (x - truth[0]) ** 2 + (y - truth[1]) ** 2 > least) belief.errors.add(x, y, truth[0], truth[1], purple);
  }
  const truth = state.frame.truth;
  if (truth) belief.errors.add(belief.pose[0], belief.pose[1], truth[0], truth[1], purple);
  drawLinks(belief);
  for (const marks of [belief.ellipses, belief.errors, belief.lines]) marks.commit();
  belief.isStale = false;
}

function drawLinks(belief) {
  const colour = new THREE.Color(state.hello.colours.link);
  const ground = new THREE.Color(state.hello.colours.ground);
  for (let k = 0; k < belief.weights.length; ++k) {
    const from = meanOf(belief, belief.links[2 * k]), to = meanOf(belief, belief.links[2 * k + 1]);
    if (!from || !to) continue;
    const shade = ground.clone().lerp(colour, Math.min(1, 0.25 + 3 * belief.weights[k]));
    belief.lines.add(from[0], from[1], to[0], to[1], shade);
  }
}

on("frame", (frame) => {
  if (frame.estimators.length !== state.beliefs.length) return;
  takeTrail(frame, common.truth, "truth");
  takeTrail(frame, common.odometry, "odometry");
  state.beliefs.forEach((belief, i) => {
    takeTrail(frame, belief.trail, `estimate${i}`);
    takeBelief(belief, i, frame);
    drawActive(belief, i);
  });
  const pose = frame.truth || (frame.estimators[0] ? frame.estimators[0].pose : frame.odometry);
  common.rays.clear();
  const rays = frame.arrays.rays;
  const mount = state.hello.sensor.mount;
  const x = pose[0] + mount[0] * Math.cos(pose[2]) - mount[1] * Math.sin(pose[2]);
  const y = pose[1] + mount[0] * Math.sin(pose[2]) + mount[1] * Math.cos(pose[2]);
  for (let k = 0; k + 2 < rays.length; k += 3) common.rays.add(x, y, rays[k], rays[k + 1], rayColours[rays[k + 2]], 0.22);
  common.rays.commit();
  common.range.position.set(x, y, 0.01);
  common.range.rotation.z = pose[2] + mount[2];
});

on("stage", () => { state.beliefs.forEach(drawActive); view.isDirty = true; });

let lastSlowMarks = 0;

/** True if something was drawn again. */
function refreshSlowMarks(now) {
  if (!state.frame || now - lastSlowMarks < 1000 * secondsBetweenSlowMarks) return false;
  lastSlowMarks = now;
  const stale = state.beliefs.map((belief, i) => i).filter((i) => state.beliefs[i].isStale && state.shown[i]);
  for (const i of stale) if (state.beliefs[i].pose) drawSlowMarks(state.beliefs[i], i);
  return stale.length > 0;
}

/** Shows the estimators and layers that are wanted in the view that is drawn next. */
function showBeliefs(isWanted) {
  const layers = state.layers;
  if (world.grid) world.grid.visible = layers.grid;
  if (!common.truth) return;
  common.truth.object.visible = layers.truth;
  common.odometry.object.visible = layers.odometry;
  common.rays.object.visible = layers.rays;
  common.range.visible = layers.range;
  state.beliefs.forEach((belief, i) => {
    belief.group.visible = isWanted(i);
    belief.trail.object.visible = belief.arrow.visible = layers.estimate;
    belief.dots.object.visible = layers.landmarks;
    belief.ellipses.object.visible = layers.ellipses;
    belief.errors.object.visible = layers.errors;
    belief.activeDots.object.visible = belief.activeLines.object.visible = layers.active;
    belief.lines.object.visible = layers.links;
  });
}
