// SPDX-License-Identifier: GPL-3.0-or-later
// From a shape of the page, its colouring and whether edges are wanted, to what three.js draws.

const geometries = new Map(), smoothed = new Map(), edges = new Map();

/** Of more faces each is too small to be seen, and the search for creases takes seconds. */
const MOST_SMOOTHED = 200000;

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
  const colors = coloring && colorsOf(coloring);
  if (colors) geometry.setAttribute("color", new THREE.BufferAttribute(colors, 3, true));
  if (shape.kind === "points") return pointsOf(geometry, coloring);
  // Edges show the faces, which are flat then; without them the surface is smooth between its creases.
  const smooth = !withEdges && geometry.index.count <= 3 * MOST_SMOOTHED;
  const shaded = smooth ? cached(smoothed, shape, () => THREE.toCreasedNormals(geometry, page.crease)) : geometry;
  if (smooth && colors) shaded.setAttribute("color", new THREE.BufferAttribute(ofCorners(colors, geometry), 3, true));
  const looks = coloring ? { vertexColors: true } : { color: page.colors.front };
  // Edges lie on the faces: these step back a little.
  const solid = { flatShading: !smooth, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1 };
  const sides = [{ ...looks, side: THREE.FrontSide }, { color: page.colors.back, side: THREE.BackSide }];
  const objects = sides.map((side) => new THREE.Mesh(shaded, new THREE.MeshLambertMaterial({ ...solid, ...side })));
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
