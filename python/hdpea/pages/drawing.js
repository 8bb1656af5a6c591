// SPDX-License-Identifier: GPL-3.0-or-later
// One camera, one canvas, one or two panels: each a scene of its own, side by side, or one above the other on a phone.

THREE.ColorManagement.enabled = false;
const canvas = document.querySelector("canvas");
const renderer = madeRenderer();
renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
renderer.setClearColor("white");
renderer.info.autoReset = false;

const camera = new THREE.PerspectiveCamera(30, 1, 0.01, 10);
camera.up.fromArray(page.up);
camera.add(new THREE.DirectionalLight("white", 2.2));
camera.children[0].position.set(-0.4, 0.6, 1);
const controls = new THREE.OrbitControls(camera, canvas);
controls.addEventListener("change", redraw);

function madeRenderer() {
  try {
    return new THREE.WebGLRenderer({ canvas, antialias: true });
  } catch (error) {
    document.querySelector("aside").textContent = "This page needs WebGL, which is missing or switched off here.";
    throw error;
  }
}

function sceneOf(objects) {
  const scene = new THREE.Scene();
  scene.add(new THREE.AmbientLight("white", 1.1), ...objects);
  return scene;
}

/** Frees what an object holds on the graphics card, but for the geometries that are kept. */
function forget(object) {
  object.material?.dispose();
  if (!object.isInstancedMesh) return;
  object.geometry.dispose();
  object.dispose();
}

let scenes = [];

function show(shown) {
  scenes.flatMap((scene) => scene.children).forEach(forget);
  const refit = scenes.length !== shown.length;
  scenes = shown.map(sceneOf);
  controls.zoomToCursor = shown.length === 1;
  if (refit) fit();
  redraw();
}

/** Rectangles of the panels in CSS pixels, from the lower left. */
function panels() {
  const { clientWidth: width, clientHeight: height } = canvas;
  document.documentElement.classList.toggle("stacked", width <= height); // for the names below them
  if (scenes.length < 2) return [[0, 0, width, height]];
  if (width > height) return [[0, 0, width / 2, height], [width / 2, 0, width / 2, height]];
  return [[0, height / 2, width, height / 2], [0, 0, width, height / 2]];
}

/** As near as all of the box can be seen, from where the camera is looking. */
function fit() {
  const [, , width, height] = panels()[0];
  const tangent = Math.tan((camera.fov / 2) * (Math.PI / 180)), aspect = width / height;
  const turned = camera.quaternion.clone().invert();
  let away = 0;
  for (let corner = 0; corner < 8; ++corner) {
    const { x, y, z } = new THREE.Vector3(...page.extent.map((each, i) => (corner >> i & 1 ? each : -each) / 2))
      .applyQuaternion(turned);
    away = Math.max(away, z + Math.abs(x) / tangent / aspect, z + Math.abs(y) / tangent);
  }
  controls.target.set(0, 0, 0);
  camera.position.set(0, 0, 1.08 * away).applyQuaternion(camera.quaternion);
  controls.update();
}

function reset() {
  camera.position.fromArray(page.eye);
  camera.lookAt(0, 0, 0);
  fit();
}

function draw() {
  renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
  renderer.setSize(canvas.clientWidth, canvas.clientHeight, false);
  renderer.setScissorTest(true);
  renderer.info.reset();
  const away = camera.position.length();
  camera.near = Math.max(away - 1, 0.001);
  camera.far = away + 1;
  panels().forEach(([x, y, width, height], i) => {
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    renderer.setViewport(x, y, width, height);
    renderer.setScissor(x, y, width, height);
    scenes[i].add(camera); // its light must be part of the scene
    renderer.render(scenes[i], camera);
  });
  document.body.dataset.triangles = renderer.info.render.triangles;
  document.body.dataset.points = renderer.info.render.points;
}

let waiting = false;
function redraw() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    draw();
  });
}

canvas.addEventListener("dblclick", reset);
window.addEventListener("resize", redraw);
