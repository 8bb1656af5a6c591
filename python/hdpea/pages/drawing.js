// SPDX-License-Identifier: GPL-3.0-or-later
// One camera, one canvas, one or two panels: each a scene of its own, side by side, or one above the other on a phone.

THREE.ColorManagement.enabled = false;
const canvas = document.querySelector("canvas");
const renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
renderer.setClearColor("white");
renderer.info.autoReset = false;

const camera = new THREE.PerspectiveCamera(30, 1, 0.01, 10);
camera.up.fromArray(page.up);
camera.add(new THREE.DirectionalLight("white", 2.2));
camera.children[0].position.set(-0.4, 0.6, 1);
const controls = new THREE.OrbitControls(camera, canvas);
controls.zoomToCursor = true;
controls.addEventListener("change", redraw);

const geometries = new Map(), edges = new Map();

function cached(cache, shape, make) {
  if (!cache.has(shape)) cache.set(shape, make(shape));
  return cache.get(shape);
}

/** Squares of so many pixels, as bright as their surface faces the light: whichever side is out. */
const pointMaterial = new THREE.ShaderMaterial({
  vertexColors: true,
  uniforms: { size: { value: 1 }, plain: { value: null }, colored: { value: 0 } },
  vertexShader: `
    uniform float size, colored;
    uniform vec3 plain;
    varying vec3 shown;
    void main() {
      vec3 facing = normalMatrix * normal;
      float length = length(facing);
      float light = length > 0.0 ? abs(dot(facing / length, normalize(vec3(-0.3, 0.5, 1.0)))) : 0.7;
      shown = mix(plain, color, colored) * (0.45 + 0.6 * light);
      gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      gl_PointSize = size;
    }`,
  fragmentShader: "varying vec3 shown; void main() { gl_FragColor = vec4(shown, 1.0); }",
});

function pointsOf(geometry, coloring) {
  const material = pointMaterial.clone();
  const size = Math.max(1.5, Math.min(5, 700 / Math.sqrt(geometry.attributes.position.count)));
  material.uniforms.size.value = size * renderer.getPixelRatio();
  material.uniforms.plain.value = new THREE.Color(page.colors.front);
  material.uniforms.colored.value = coloring ? 1 : 0;
  return [new THREE.Points(geometry, material)];
}

/** Points over the mesh that they belong to: small, of a colour of their own. */
function dotsOf(shape) {
  const [points] = pointsOf(cached(geometries, shape, geometryOf));
  points.material.uniforms.size.value = 1.5 * renderer.getPixelRatio();
  points.material.uniforms.plain.value.set(page.colors.dots);
  return points;
}

function objectsOf(shape, coloring, withEdges) {
  if (shape.kind === "ellipsoids") return ellipsoidsOf(shape, coloring);
  const geometry = cached(geometries, shape, geometryOf);
  if (coloring) geometry.setAttribute("color", new THREE.BufferAttribute(colorsOf(coloring), 3, true));
  if (shape.kind === "points") return pointsOf(geometry, coloring);
  const looks = coloring ? { vertexColors: true } : { color: page.colors.front };
  // Edges lie on the faces: these step back a little.
  const solid = { flatShading: true, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
  const sides = [{ ...looks, side: THREE.FrontSide }, { color: page.colors.back, side: THREE.BackSide }];
  const objects = sides.map((side) => new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ ...solid, ...side })));
  if (withEdges) {
    const lines = cached(edges, shape, () => edgesOf(geometry));
    const material = new THREE.LineBasicMaterial({ color: page.colors.edges, transparent: true, opacity: 0.6 });
    objects.push(new THREE.LineSegments(lines, material));
  }
  return objects;
}

/** Ellipsoids, each on a disk that hides what lies behind the surface. */
function ellipsoidsOf(shape, coloring) {
  const ellipsoids = new THREE.InstancedMesh(
    new THREE.SphereGeometry(1, 12, 8), new THREE.MeshLambertMaterial(), shape.count);
  matricesOf(shape, (axis) => axis).forEach((matrix, i) => ellipsoids.setMatrixAt(i, matrix));
  const colors = colorsOf(coloring || shape.colorings[0]);
  const color = new THREE.Color();
  for (let i = 0; i < shape.count; ++i) {
    ellipsoids.setColorAt(i, color.setRGB(...Array.from(colors.subarray(3 * i, 3 * i + 3), (each) => each / 255)));
  }
  const plates = new THREE.InstancedMesh(
    new THREE.CircleGeometry(shape.plate, 12),
    new THREE.MeshLambertMaterial({ color: "#f4f4f4", side: THREE.DoubleSide }), shape.count);
  matricesOf(shape, (axis) => axis.normalize()).forEach((matrix, i) => plates.setMatrixAt(i, matrix));
  return [plates, ellipsoids];
}

function sceneOf(objects) {
  const scene = new THREE.Scene();
  scene.add(new THREE.AmbientLight("white", 1.1), ...objects);
  return scene;
}

let scenes = [];

function show(shown) {
  scenes.flatMap((scene) => scene.children).forEach((each) => each.material?.dispose());
  const refit = scenes.length !== shown.length;
  scenes = shown.map(sceneOf);
  if (refit) fit();
  redraw();
}

/** Rectangles of the panels in CSS pixels, from the lower left. */
function panels() {
  const { clientWidth: width, clientHeight: height } = canvas;
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
