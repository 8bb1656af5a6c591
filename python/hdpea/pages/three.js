// SPDX-License-Identifier: GPL-3.0-or-later
// What the pages use of three.js; `make three` bundles it into three.min.js.
export {
  AmbientLight, BackSide, BufferAttribute, BufferGeometry, CircleGeometry, Color, ColorManagement, DirectionalLight,
  DoubleSide, FrontSide, Group, InstancedMesh, LinearSRGBColorSpace, LineBasicMaterial, LineSegments, Matrix4, Mesh,
  MeshLambertMaterial, PerspectiveCamera, Points, Scene, ShaderMaterial, SphereGeometry, Vector3, WebGLRenderer,
} from "three";
export { toCreasedNormals } from "three/examples/jsm/utils/BufferGeometryUtils.js";
export { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
