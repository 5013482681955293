// The world: ground, walls, true landmarks, and the robot.

const world = { group: new THREE.Group(), robot: null, parts: [], ghost: null, solids: null, posts: null };
view.scene.add(world.group);

const unitBox = new THREE.BoxBufferGeometry(1, 1, 1);
const unitCylinder = new THREE.CylinderBufferGeometry(0.5, 0.5, 1, 20).rotateX(0.5 * Math.PI);
const post = (sides) => new THREE.CylinderBufferGeometry(1, 1, 1, sides).rotateX(0.5 * Math.PI).translate(0, 0, 0.5);
const roundPost = post(12), roughPost = post(5);
const mostRoundPosts = 300;
const postHeight = 0.7;        // [m]
const mostNearPosts = 1500;    // drawn as cylinders; farther ones are points

function solidMaterial(colour) { return new THREE.MeshLambertMaterial({ color: colour }); }

function clearGroup(group) { while (group.children.length > 0) group.remove(group.children[0]); }

function makeGround(hello) {
  const [width, height] = hello.ground;
  const plane = new THREE.Mesh(new THREE.PlaneBufferGeometry(width, height), new THREE.MeshBasicMaterial({ color: hello.colours.ground, depthWrite: false }));
  plane.renderOrder = -3;
  plane.position.z = -0.02;
  world.group.add(plane);
  const step = Math.max(width, height) > 400 ? 10 : 1;
  const lines = [];
  for (let x = Math.ceil(-width / 2 / step) * step; x <= width / 2; x += step) lines.push(x, -height / 2, 0, x, height / 2, 0);
  for (let y = Math.ceil(-height / 2 / step) * step; y <= height / 2; y += step) lines.push(-width / 2, y, 0, width / 2, y, 0);
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(lines), 3));
  world.grid = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color: hello.colours.grid, depthWrite: false }));
  world.grid.renderOrder = -2;
  world.grid.position.z = -0.01;
  world.group.add(world.grid);
}

function makeRobot(hello) {
  world.robot = new THREE.Group();
  world.parts = hello.robot.map((part) => {
    const mesh = new THREE.Mesh(part.shape === "box" ? unitBox : unitCylinder, solidMaterial(part.colour));
    mesh.matrixAutoUpdate = false;
    const still = new THREE.Matrix4().fromArray(part.T);
    const size = new THREE.Matrix4().makeScale(...part.size);
    world.robot.add(mesh);
    return { mesh, still, size, wheel: part.wheel };
  });
  turnWheels(0, 0);
  world.group.add(world.robot);
  world.ghost = new THREE.Mesh(new THREE.CircleBufferGeometry(0.3, 24), new THREE.MeshBasicMaterial({ color: 0xd55e00, transparent: true, opacity: 0.7 }));
  world.ghost.position.z = 0.05;
  world.ghost.visible = false;
  world.group.add(world.ghost);
}

/** A wheel turns about the robot's y axis, through its own middle. */
function turnWheels(left, right) {
  for (const part of world.parts) {
    const angle = part.wheel === "left" ? left : part.wheel === "right" ? right : 0;
    const p = new THREE.Vector3().setFromMatrixPosition(part.still);
    part.mesh.matrix.makeTranslation(p.x, p.y, p.z)
      .multiply(new THREE.Matrix4().makeRotationY(angle))
      .multiply(new THREE.Matrix4().makeTranslation(-p.x, -p.y, -p.z))
      .multiply(part.still).multiply(part.size);
  }
}

on("hello", (hello) => {
  clearGroup(world.group);
  view.renderer.setClearColor(hello.colours.sky);
  makeGround(hello);
  makeRobot(hello);
  world.solids = null;
  world.posts = { ids: new Map(), places: new Float32Array(0), count: 0, near: null, far: null };
  setCamera(view.mode);
});

on("solids", ({ arrays }) => {
  if (world.solids) world.group.remove(world.solids);
  world.solids = new THREE.Group();
  for (let i = 0; i < arrays.tints.length; ++i) {
    const mesh = new THREE.Mesh(unitBox, solidMaterial(arrays.tints[i]));
    const values = arrays.solids.subarray(19 * i, 19 * i + 19);
    mesh.matrixAutoUpdate = false;
    mesh.matrix.fromArray(values).multiply(new THREE.Matrix4().makeScale(values[16], values[17], values[18]));
    world.solids.add(mesh);
  }
  world.group.add(world.solids);
  view.isDirty = true;
});

on("posts", (message) => {
  const posts = world.posts;
  const places = new Float32Array(3 * message.total);
  places.set(posts.places.subarray(0, 3 * message.first));
  places.set(message.arrays.posts, 3 * message.first);
  message.arrays.ids.forEach((id, i) => posts.ids.set(id, message.first + i));
  posts.places = places;
  posts.count = message.first + message.arrays.ids.length;
  drawPosts();
});

/** All posts as points, and those near the middle of the picture as cylinders. */
function drawPosts() {
  const posts = world.posts;
  if (posts.far) world.group.remove(posts.far, posts.near);
  const points = new Float32Array(3 * posts.count);
  for (let i = 0; i < posts.count; ++i) {
    points[3 * i] = posts.places[3 * i];
    points[3 * i + 1] = posts.places[3 * i + 1];
    points[3 * i + 2] = 0.02;
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
  const colour = state.hello.colours.post;
  posts.far = new THREE.Points(geometry, new THREE.PointsMaterial({ color: colour, size: 2, sizeAttenuation: false }));
  posts.far.visible = posts.count > mostNearPosts;
  posts.near = new THREE.InstancedMesh(posts.count > mostRoundPosts ? roughPost : roundPost, solidMaterial(colour), Math.min(posts.count, mostNearPosts));
  posts.near.frustumCulled = posts.far.frustumCulled = false;
  posts.middle = null;
  world.group.add(posts.far, posts.near);
  choosePosts();
  view.isDirty = true;
}

function choosePosts() {
  const posts = world.posts;
  if (!posts || !posts.near) return;
  const middle = view.controls.target;
  if (posts.middle && (posts.count <= mostNearPosts || posts.middle.distanceTo(middle) < 8)) return;
  posts.middle = middle.clone();
  let reach = Infinity;
  if (posts.count > mostNearPosts) {
    const area = state.hello.ground[0] * state.hello.ground[1];
    reach = 0.9 * Math.sqrt(mostNearPosts / posts.count * area / Math.PI);
  }
  const matrix = new THREE.Matrix4();
  let count = 0;
  const most = Math.min(posts.count, mostNearPosts);
  for (let i = 0; i < posts.count && count < most; ++i) {
    const x = posts.places[3 * i], y = posts.places[3 * i + 1], radius = posts.places[3 * i + 2];
    if (Math.hypot(x - middle.x, y - middle.y) > reach) continue;
    matrix.makeScale(radius, radius, postHeight).setPosition(x, y, 0);
    posts.near.setMatrixAt(count++, matrix);
  }
  posts.near.count = count;
  posts.near.instanceMatrix.needsUpdate = true;
}

/** Where a landmark really is; null if it is not known. */
function truePlace(id) {
  const number = world.posts ? world.posts.ids.get(id) : undefined;
  return number === undefined ? null : world.posts.places.subarray(3 * number, 3 * number + 2);
}

on("frame", (frame) => {
  const pose = frame.truth || (frame.estimators[0] ? frame.estimators[0].pose : frame.odometry);
  world.robot.position.set(pose[0], pose[1], 0);
  world.robot.rotation.z = pose[2];
  if (frame.truth) turnWheels(frame.truth[3], frame.truth[4]);
  followRobot(pose[0], pose[1], pose[2]);
  choosePosts();
  view.isDirty = true;
});
