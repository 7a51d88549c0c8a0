// What a scene is, and how it is read from its file (docs/scene-format.md). Vectors and colours are arrays of three.
import { readFileSync } from "node:fs";
import { dirname, join } from "node:path";

export const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (k, a) => [k * a[0], k * a[1], k * a[2]];
export const multiply = (a, b) => [a[0] * b[0], a[1] * b[1], a[2] * b[2]]; // colours, channel by channel
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = (a) => Math.sqrt(dot(a, a));
export const unit = (a) => scale(1 / length(a), a);

// A key that the file does not state, or states as null, has the default of the format, which stands behind each `??`.
export function load(path) {
  const stated = JSON.parse(readFileSync(path, "utf8"));
  const background = stated.background ?? { color: [0, 0, 0] };
  const materials = readMaterials(stated.materials);
  const scene = {
    isRadiometric: stated.convention === "radiometric",
    maxDepth: stated.max_depth ?? 0,
    camera: readCamera(stated.camera, materials),
    bottom: background.color ?? background.bottom,
    top: background.color ?? background.top,
    ambientLight: stated.ambient_light ?? [0, 0, 0],
    lights: (stated.lights ?? []).map(readLight),
    spheres: [],
    triangles: [],
    planes: [],
  };
  for (const shape of stated.objects) {
    const material = materials.get(shape.material);
    if (shape.shape === "sphere") scene.spheres.push({ center: shape.center, radius: shape.radius, material });
    else if (shape.shape === "plane") scene.planes.push({ point: shape.point, normal: unit(shape.normal), material }); // PLANE-4
    else for (const triangle of readTriangles(shape, dirname(path), material)) scene.triangles.push(triangle);
  }
  return scene;
}

function readCamera(stated, materials) {
  const forward = unit(subtract(stated.look_at, stated.position)); // CAM-1
  const right = unit(cross(forward, stated.up ?? [0, 1, 0]));
  const isPerspective = stated.projection === "perspective";
  // The height of the image plane: CAM-3 at the distance 1, CAM-4.
  const viewHeight = isPerspective ? 2 * Math.tan((stated.vertical_field_of_view * Math.PI) / 360) : stated.view_height;
  return {
    position: stated.position,
    forward,
    right,
    down: cross(forward, right),
    isPerspective,
    pixel: viewHeight / stated.height,
    width: stated.width,
    height: stated.height,
    inside: stated.inside == null ? null : materials.get(stated.inside),
  };
}

function readLight(stated) {
  if (stated.kind === "directional") return { direction: unit(stated.direction), intensity: stated.irradiance };
  const isPolynomial = typeof stated.falloff === "object";
  const simple = { constant: 0, linear: 0, quadratic: 0, [stated.falloff === "none" ? "constant" : "quadratic"]: 1 };
  return { position: stated.position, intensity: stated.intensity, falloff: isPolynomial ? stated.falloff : simple, isPolynomial };
}

function readMaterials(stated) {
  const materials = new Map(Object.entries(stated).map(([name, terms]) => [name, readMaterial(terms)]));
  for (const { dielectric } of materials.values())
    if (dielectric) dielectric.outside = dielectric.outside == null ? null : materials.get(dielectric.outside);
  return materials;
}

function readMaterial(stated) {
  return {
    ambient: stated.ambient?.reflectance,
    diffuse: readTexture(stated.diffuse?.reflectance),
    specular: stated.specular,
    mirror: stated.mirror?.reflectance,
    emission: readTexture(stated.emission?.radiance),
    dielectric: stated.dielectric,
  };
}

// The colour at each point of a surface, as a function of the point.
function readTexture(stated) {
  if (stated == null) return null;
  if (Array.isArray(stated)) return () => stated;
  const { even, odd, size, plane, offset } = stated.checkerboard;
  const [u, v] = [...(plane ?? "xz")].map((axis) => "xyz".indexOf(axis));
  const [offsetU, offsetV] = offset ?? [0, 0];
  const side = size ?? 1;
  // TEX-1, TEX-2
  return (p) => ((Math.floor((p[u] - offsetU) / side) + Math.floor((p[v] - offsetV) / side)) % 2 === 0 ? even : odd);
}

function readTriangles(stated, folder, material) {
  const { vertices, faces } = stated.file == null ? stated : readObj(join(folder, stated.file));
  const triangles = [];
  for (const [first, ...others] of faces ?? [[0, 1, 2]]) {
    const a = vertices[first];
    for (let i = 1; i < others.length; i++) { // a face of more corners is a fan
      const ab = subtract(vertices[others[i - 1]], a);
      const ac = subtract(vertices[others[i]], a);
      triangles.push({ a, ab, ac, normal: unit(cross(ab, ac)), material }); // TRI-4
    }
  }
  return triangles;
}

// The corners and faces of an OBJ file, of the kind that raytruth writes beside very large scenes.
function readObj(path) {
  const vertices = [];
  const faces = [];
  for (const line of readFileSync(path, "utf8").split("\n")) {
    const [keyword, ...words] = line.trim().split(/\s+/);
    if (keyword === "v") vertices.push(words.slice(0, 3).map(Number));
    // 7, 7/1 or 7/1/3: counted from 1; or -1, backwards from the last vertex
    if (keyword === "f") faces.push(words.map((word) => parseInt(word)).map((n) => (n > 0 ? n - 1 : n + vertices.length)));
  }
  return { vertices, faces };
}
