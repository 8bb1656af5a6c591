// SPDX-License-Identifier: GPL-3.0-or-later
// From the numbers in the page to geometry. hdpea/pages/encoding.py is the other side of this.

function bytesOf(text) {
  return Uint8Array.from(atob(text), (each) => each.charCodeAt(0));
}

/** Positions (3 n) in the page's frame, from steps of 16 bits along each side of its box. */
function positionsOf(text) {
  const steps = new Uint16Array(bytesOf(text).buffer);
  return Float32Array.from(steps, (step, i) => page.origin[i % 3] + (page.extent[i % 3] * step) / 65535);
}

function geometryOf(shape) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positionsOf(shape.positions), 3));
  if (shape.kind === "points") {
    const normals = new Int8Array(bytesOf(shape.normals).buffer);
    geometry.setAttribute("normal", new THREE.BufferAttribute(normals, 3, true));
  }
  if (shape.kind === "mesh") {
    const bytes = bytesOf(shape.faces).buffer;
    const corners = shape.wide ? new Uint32Array(bytes) : new Uint16Array(bytes);
    geometry.setIndex(new THREE.BufferAttribute(corners, 1));
    geometry.computeVertexNormals();
  }
  return geometry;
}

/** Every edge of the mesh once. */
function edgesOf(geometry) {
  const corners = geometry.index.array, count = geometry.attributes.position.count;
  const seen = new Set(), ends = [];
  for (let i = 0; i < corners.length; i += 3) {
    for (let k = 0; k < 3; ++k) {
      const a = corners[i + k], b = corners[i + (k + 1) % 3];
      const edge = Math.min(a, b) * count + Math.max(a, b);
      if (!seen.has(edge)) {
        seen.add(edge);
        ends.push(a, b);
      }
    }
  }
  const edges = new THREE.BufferGeometry();
  edges.setAttribute("position", geometry.attributes.position);
  edges.setIndex(ends);
  return edges;
}

/** The colour at a share of 0 to 1 of the ramp, as bytes. */
function rampAt(share) {
  const place = share * (page.ramp.length - 1), before = Math.min(Math.floor(place), page.ramp.length - 2);
  return page.ramp[before].map((low, i) => Math.round(low + (place - before) * (page.ramp[before + 1][i] - low)));
}

/** Colours (3 n) as bytes of a colouring; 255 in place of a share stands for unknown. */
function colorsOf(coloring) {
  const values = bytesOf(coloring.values);
  if (coloring.kind === "colors") return values;
  const table = Array.from({ length: 256 }, (_, value) => (value === 255 ? page.unknown : rampAt(value / 254)));
  const colors = new Uint8Array(3 * values.length);
  values.forEach((value, i) => colors.set(table[value], 3 * i));
  return colors;
}

/** Colours (3 n) of vertices at the corners of the faces, one after the other. */
function ofCorners(colors, geometry) {
  const corners = geometry.index.array, spread = new Uint8Array(3 * corners.length);
  corners.forEach((vertex, i) => spread.set(colors.subarray(3 * vertex, 3 * vertex + 3), 3 * i));
  return spread;
}

/** A matrix for each ellipsoid, from its centre and half axes, whose third is the normal. */
function matricesOf(shape, scaled) {
  const centres = new Float32Array(bytesOf(shape.centres).buffer), axes = new Float32Array(bytesOf(shape.axes).buffer);
  return Array.from({ length: centres.length / 3 }, (_, i) => {
    const [a, b, c] = [0, 3, 6].map((k) => scaled(new THREE.Vector3().fromArray(axes, 9 * i + k)));
    return new THREE.Matrix4().makeBasis(a, b, c).setPosition(...centres.subarray(3 * i, 3 * i + 3));
  });
}
