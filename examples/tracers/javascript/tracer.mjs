// A Whitted ray tracer, written to raytruth's docs/spec.md, whose clauses are named beside the lines they belong to.
//
//     node tracer.mjs SCENE.json OUTPUT.pfm                      the picture
//     node tracer.mjs SCENE.json OUTPUT.pfm --trace COLUMN ROW   the rays of one pixel, for `raytruth trace`
import { writeFileSync } from "node:fs";
import { add, cross, dot, length, load, multiply, scale, subtract, unit } from "./scene.mjs";

// A ray has an origin, a unit direction, the primitive that it `leaves`, if it starts on one, and a `path`: which mirrors
// (M), reflections (R) and refractions (T) of glass it has come by.

const [sceneFile, output, trace, traceColumn, traceRow] = process.argv.slice(2);

// Prints a ray and what came of it as a line of JSON, if the rays of a pixel are asked for.
function note(ray, told) {
  const { path, origin, direction } = ray;
  if (trace) console.log(JSON.stringify({ path, origin, direction, ...told }));
}

// The distance to the sphere, or infinity. Textbook quadratic: t² + 2bt + c = 0.
function meetSphere(ray, sphere) {
  const fromCenter = subtract(ray.origin, sphere.center);
  const b = dot(ray.direction, fromCenter);
  if (ray.leaves === sphere) return b < 0 ? -2 * b : Infinity; // SPH-4
  const discriminant = b * b - (dot(fromCenter, fromCenter) - sphere.radius * sphere.radius);
  if (discriminant < 0) return Infinity; // SPH-2
  const root = Math.sqrt(discriminant);
  if (-b - root > 0) return -b - root; // SPH-1
  return -b + root > 0 ? -b + root : Infinity;
}

// The distance to the triangle, or infinity (Möller and Trumbore 1997). TRI-1 to TRI-3.
function meetTriangle(ray, triangle) {
  if (ray.leaves === triangle) return Infinity;
  const p = cross(ray.direction, triangle.ac);
  const determinant = dot(triangle.ab, p);
  if (determinant === 0) return Infinity;
  const s = subtract(ray.origin, triangle.a);
  const u = dot(s, p) / determinant;
  if (u < 0 || u > 1) return Infinity;
  const q = cross(s, triangle.ab);
  const v = dot(ray.direction, q) / determinant;
  if (v < 0 || u + v > 1) return Infinity;
  const distance = dot(triangle.ac, q) / determinant;
  return distance > 0 ? distance : Infinity;
}

// The distance to the plane, or infinity. PLANE-1 to PLANE-3.
function meetPlane(ray, plane) {
  const along = dot(ray.direction, plane.normal);
  if (ray.leaves === plane || along === 0) return Infinity;
  const distance = dot(subtract(plane.point, ray.origin), plane.normal) / along;
  return distance > 0 ? distance : Infinity;
}

// The nearest hit that is nearer than `limit`. TRAV-1, TRAV-3: of equals the first stays.
function firstHit(scene, ray, limit = Infinity) {
  const hit = { distance: limit, primitive: null };
  const search = (primitives, meet) => {
    for (const primitive of primitives) {
      const distance = meet(ray, primitive);
      if (distance < hit.distance) Object.assign(hit, { distance, primitive });
    }
  };
  search(scene.spheres, meetSphere);
  search(scene.triangles, meetTriangle);
  search(scene.planes, meetPlane);
  return hit;
}

// Whether anything lies between the ray's start and the light. SHAD-1 to SHAD-4.
function isHidden(scene, ray, lightDistance) {
  return firstHit(scene, ray, lightDistance).primitive !== null;
}

// BG-1
function background(scene, direction) {
  const k = (direction[1] + 1) / 2;
  return add(scale(1 - k, scene.bottom), scale(k, scene.top));
}

// How a point light weakens with distance: ILL-7, and 1/d² of ILL-3.
function attenuation(light, distance) {
  const { constant, linear, quadratic } = light.falloff;
  const divisor = constant + linear * distance + quadratic * distance * distance;
  return light.isPolynomial && divisor <= 1 ? 1 : 1 / divisor;
}

// What one light adds where the ray hits and `reflected` starts. The normal is turned to the ray's origin.
function litBy(scene, light, ray, reflected, normal, material) {
  const point = reflected.origin;
  const way = light.direction ? scale(-1, light.direction) : subtract(light.position, point);
  const distance = light.direction ? Infinity : length(way);
  if (distance === 0) return [0, 0, 0]; // ILL-9
  const toLight = light.direction ? way : scale(1 / distance, way);
  const cosine = dot(normal, toLight);
  const shadowRay = { origin: point, direction: toLight, leaves: reflected.leaves };
  if (cosine <= 0 || isHidden(scene, shadowRay, distance)) return [0, 0, 0]; // ILL-2
  let weight = [0, 0, 0];
  if (material.diffuse) weight = scale(scene.isRadiometric ? cosine / Math.PI : cosine, material.diffuse(point)); // ILL-3
  if (material.specular) {
    const { model, exponent, reflectance } = material.specular;
    const halfway = () => unit(subtract(toLight, ray.direction));
    const highlight = model === "blinn" ? dot(normal, halfway()) : dot(reflected.direction, toLight); // ILL-6, ILL-5
    weight = add(weight, scale(Math.max(highlight, 0) ** exponent, reflectance));
  }
  return scale(light.direction ? 1 : attenuation(light, distance), multiply(weight, light.intensity));
}

// The light that comes back along a ray which has `depth` reflections and refractions left. TREE.
function radiance(scene, ray, medium, depth) {
  const { distance, primitive } = firstHit(scene, ray);
  if (!primitive) {
    const seen = background(scene, ray.direction); // BG-3: not absorbed
    note(ray, { distance: null, local: seen, color: seen });
    return seen;
  }
  const point = add(ray.origin, scale(distance, ray.direction));
  const isSphere = "radius" in primitive;
  let normal = isSphere ? unit(subtract(point, primitive.center)) : primitive.normal; // SPH-5
  const enters = dot(ray.direction, normal) < 0; // ILL-1
  if (!enters) normal = scale(-1, normal);
  const mirrorDirection = subtract(ray.direction, scale(2 * dot(ray.direction, normal), normal)); // REFL-1
  const reflected = { origin: point, direction: mirrorDirection, leaves: primitive, path: `${ray.path}M` };

  const { ambient, diffuse, specular, emission, mirror, dielectric } = primitive.material;
  let sum = [0, 0, 0];
  if (emission) sum = add(sum, emission(point));
  if (ambient) sum = add(sum, multiply(ambient, scene.ambientLight));
  if (diffuse || specular)
    for (const light of scene.lights) sum = add(sum, litBy(scene, light, ray, reflected, normal, primitive.material));
  const local = sum;
  if (depth > 0 && mirror) sum = add(sum, multiply(mirror, radiance(scene, reflected, medium, depth - 1))); // REFL-2
  if (depth > 0 && dielectric) sum = add(sum, through(scene, ray, reflected, normal, enters, medium, depth));

  const sigma = medium?.dielectric.absorption;
  if (sigma) sum = sum.map((channel, i) => channel * Math.exp(-sigma[i] * distance)); // REFR-7
  note(ray, { distance, normal, local, color: sum });
  return sum;
}

// What a dielectric reflects and refracts. The normal is turned to the ray's origin. REFR.
function through(scene, ray, reflected, normal, enters, medium, depth) {
  const material = reflected.leaves.material;
  const glass = material.dielectric;
  const outer = glass.outside ? glass.outside.dielectric.index_of_refraction : 1;
  const eta = enters ? glass.index_of_refraction / outer : outer / glass.index_of_refraction; // REFR-1
  const c = -dot(ray.direction, normal);
  const gSquared = eta * eta - 1 + c * c; // REFR-2
  const mirrored = radiance(scene, { ...reflected, path: `${ray.path}R` }, medium, depth - 1);
  if (gSquared < 0) return glass.reflectance ? multiply(glass.reflectance, mirrored) : mirrored; // REFR-5, REFR-6
  const g = Math.sqrt(gSquared);
  const rS = (c - g) / (c + g);
  const rP = (eta * eta * c - g) / (eta * eta * c + g);
  const fresnel = c > 0 ? (rS * rS + rP * rP) / 2 : 1; // REFR-4
  const transmitted = scene.isRadiometric ? (1 - fresnel) / (eta * eta) : 1 - fresnel;
  const direction = scale(1 / eta, add(ray.direction, scale(c - g, normal))); // REFR-3
  const refracted = { origin: reflected.origin, direction, leaves: reflected.leaves, path: `${ray.path}T` };
  const behind = radiance(scene, refracted, enters ? material : glass.outside, depth - 1); // REFR-9
  return add(
    multiply(glass.reflectance ?? [fresnel, fresnel, fresnel], mirrored), // REFR-6
    multiply(glass.transmittance ?? [transmitted, transmitted, transmitted], behind),
  );
}

// The ray through the centre of a pixel. CAM-3, CAM-4, IMG-1.
function cameraRay(camera, column, row) {
  const x = (column + 0.5 - camera.width / 2) * camera.pixel;
  const y = (row + 0.5 - camera.height / 2) * camera.pixel;
  const across = add(scale(x, camera.right), scale(y, camera.down));
  if (camera.isPerspective) return { origin: camera.position, direction: unit(add(camera.forward, across)), path: "" };
  return { origin: add(camera.position, across), direction: camera.forward, path: "" };
}

function main() {
  const scene = load(sceneFile);
  const { width, height, inside } = scene.camera;
  if (trace) {
    radiance(scene, cameraRay(scene.camera, Number(traceColumn), Number(traceRow)), inside, scene.maxDepth);
    return;
  }
  const header = Buffer.from(`PF\n${width} ${height}\n-1.0\n`); // the minus says little endian
  const file = Buffer.alloc(header.length + 12 * width * height);
  let end = header.copy(file);
  for (let row = height - 1; row >= 0; row--) // a PFM begins with the bottom row
    for (let column = 0; column < width; column++)
      for (const channel of radiance(scene, cameraRay(scene.camera, column, row), inside, scene.maxDepth))
        end = file.writeFloatLE(channel, end);
  writeFileSync(output, file);
}

if (process.argv.length !== (trace === "--trace" ? 7 : 4)) {
  console.error("usage: node tracer.mjs SCENE.json OUTPUT.pfm [--trace COLUMN ROW]");
  process.exit(2);
}
main();
