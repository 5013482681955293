// The renderer, the camera and its ways to move.

const view = {
  renderer: null, scene: new THREE.Scene(), camera: null, controls: null,
  mode: "overview", isDirty: true, robot: new THREE.Vector3(), heading: 0,
};
const shortestRobot = 20;  // [px]
const calm = window.matchMedia("(prefers-reduced-motion: reduce)").matches;

function startView() {
  const canvas = byId("scene");
  view.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
  view.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
  view.camera = new THREE.PerspectiveCamera(40, 1, 0.1, 4000);
  view.camera.up.set(0, 0, 1);
  view.camera.position.set(0, -20, 20);
  view.controls = new THREE.OrbitControls(view.camera, canvas);
  view.controls.maxPolarAngle = 0.49 * Math.PI;
  view.controls.minDistance = 1;
  view.controls.maxDistance = 3000;
  view.controls.autoRotateSpeed = 0.6;
  view.controls.addEventListener("change", () => { view.isDirty = true; });
  view.scene.add(new THREE.HemisphereLight(0xffffff, 0xb8bec4, 0.75));
  const sun = new THREE.DirectionalLight(0xffffff, 0.45);
  sun.position.set(-0.4, -0.6, 1);
  view.scene.add(sun);
  new ResizeObserver(resize).observe(byId("stage-view"));
  for (const button of document.querySelectorAll("[data-camera]"))
    button.onclick = () => setCamera(button.dataset.camera);
}

function resize() {
  const { clientWidth: width, clientHeight: height } = byId("stage-view");
  if (width === 0 || height === 0) return;
  view.renderer.setSize(width, height, false);
  view.isDirty = true;
}

/** Looks at a rectangle of the ground as a whole. */
function overview() {
  if (!state.hello) return;
  const { min, max } = state.hello.view;
  const middle = new THREE.Vector3(0.5 * (min[0] + max[0]), 0.5 * (min[1] + max[1]), 0);
  const aspect = aspectOfViews();
  const reach = Math.max((max[1] - min[1]) * 0.95, (max[0] - min[0]) / aspect);
  const distance = 0.62 * reach / Math.tan(0.5 * view.camera.fov * Math.PI / 180);
  view.controls.target.copy(middle);
  view.camera.position.set(middle.x, middle.y - 0.62 * distance, 0.85 * distance);
}

function setCamera(mode) {
  view.mode = mode;
  view.controls.autoRotate = mode === "orbit" && !calm;
  if (mode === "overview") overview();
  if (mode === "top") {
    const height = Math.max(12, 1.6 * ((state.hello && state.hello.sensor.range_m) || 8));
    view.controls.target.copy(view.robot);
    view.camera.position.set(view.robot.x, view.robot.y - 0.01, height);
  }
  if (mode === "follow" || mode === "orbit") {
    view.controls.target.copy(view.robot);
    view.camera.position.set(view.robot.x - 7 * Math.cos(view.heading), view.robot.y - 7 * Math.sin(view.heading), 6);
  }
  for (const button of document.querySelectorAll("[data-camera]"))
    button.setAttribute("aria-pressed", String(button.dataset.camera === mode));
  view.controls.update();
  view.isDirty = true;
}

/** The camera keeps its place relative to the robot. */
function followRobot(x, y, heading) {
  const moved = new THREE.Vector3(x, y, 0).sub(view.robot);
  view.robot.set(x, y, 0);
  view.heading = heading;
  if (view.mode === "overview") return;
  view.controls.target.add(moved);
  view.camera.position.add(moved);
}

/** The estimators that have a view of their own; empty: all share one. */
function sides() {
  if (!byId("side").checked) return [];
  const shown = state.shown.map((isShown, i) => isShown ? i : -1).filter((i) => i >= 0).slice(0, 2);
  return shown.length === 2 ? shown : [];
}

function aspectOfViews() {
  const canvas = byId("stage-view");
  return Math.max(0.2, canvas.clientWidth / (sides().length || 1) / Math.max(1, canvas.clientHeight));
}

/** How long a metre is at a point. [px] */
function metreAt(point) {
  const distance = Math.max(0.1, view.camera.position.distanceTo(point));
  return byId("stage-view").clientHeight / (2 * Math.tan(0.5 * view.camera.fov * Math.PI / 180) * distance);
}

/** From far away the robot is drawn larger than it is, so that it can be seen, and dots are smaller, so that they do not
 * cover the map. */
function sizeMarks() {
  if (!world.robot) return;
  const size = Math.max(1, shortestRobot / (0.45 * metreAt(world.robot.position)));
  const share = Math.min(1, Math.max(0.4, metreAt(view.controls.target) / 12));
  world.robot.scale.setScalar(size);
  for (const belief of state.beliefs) {
    belief.arrow.scale.setScalar(size);
    belief.dots.material.size = 6.5 * share;
    belief.activeDots.material.size = 11.5 * share;
  }
}

function render() {
  sizeMarks();
  const { clientWidth: width, clientHeight: height } = byId("stage-view");
  const parts = sides();
  view.camera.aspect = aspectOfViews();
  view.camera.updateProjectionMatrix();
  view.renderer.setScissorTest(parts.length > 0);
  const each = width / Math.max(1, parts.length);
  for (let part = 0; part < Math.max(1, parts.length); ++part) {
    view.renderer.setViewport(part * each, 0, each, height);
    view.renderer.setScissor(part * each, 0, each, height);
    showBeliefs(parts.length > 0 ? (i) => i === parts[part] : (i) => state.shown[i]);
    view.renderer.render(view.scene, view.camera);
  }
  showTitles(parts, each);
  view.isDirty = false;
  if (state.firstPicture === null && state.frame) state.firstPicture = performance.now();
}

function showTitles(parts, width) {
  const names = parts.map((i) => state.hello.estimators[i].name).join("|");
  if (byId("titles").dataset.names === names + width) return;
  byId("titles").dataset.names = names + width;
  byId("titles").replaceChildren(...parts.map((i, part) => {
    const title = document.createElement("span");
    title.textContent = state.hello.estimators[i].name;
    title.style.left = `${part * width + 8}px`;
    return title;
  }));
}

/** The point of the ground under a point of the canvas; null in the sky. */
function groundAt(clientX, clientY) {
  const box = byId("scene").getBoundingClientRect();
  const count = sides().length || 1;
  const share = ((clientX - box.left) / box.width * count) % 1;
  const pointer = new THREE.Vector2(2 * share - 1, 1 - 2 * (clientY - box.top) / box.height);
  const ray = new THREE.Raycaster();
  ray.setFromCamera(pointer, view.camera);
  return ray.ray.intersectPlane(new THREE.Plane(new THREE.Vector3(0, 0, 1), 0), new THREE.Vector3());
}
