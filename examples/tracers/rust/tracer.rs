//! A Whitted ray tracer, written to raytruth's docs/spec.md, whose clauses are named beside the lines they belong to.
//!
//!     tracer SCENE.json OUTPUT.pfm                      the picture
//!     tracer SCENE.json OUTPUT.pfm --trace COLUMN ROW   the rays of one pixel, for `raytruth trace`

mod json;
mod scene;

use scene::{Camera, Light, Scene, Shape, Source, Vec3};
use std::f64::consts::PI;
use std::f64::INFINITY;

/// A half-line in a unit direction, and the number of the primitive on whose surface it starts.
struct Ray {
    origin: Vec3,
    direction: Vec3,
    leaves: Option<usize>,
    path: Option<String>, // of a pixel's rays that are traced: which mirrors (M), reflections (R) and refractions (T)
}

impl Ray {
    /// The path of a ray that goes on from this one.
    fn then(&self, way: char) -> Option<String> {
        self.path.as_ref().map(|path| format!("{path}{way}"))
    }

    /// Print the ray and what came of it as a line of JSON, if it is traced.
    fn note(&self, hit: Option<(f64, usize, Vec3)>, local: Vec3, color: Vec3) {
        let Some(path) = &self.path else { return };
        let rays = format!("\"origin\": {:?}, \"direction\": {:?}", self.origin.0, self.direction.0);
        let colors = format!("\"local\": {:?}, \"color\": {:?}", local.0, color.0);
        let end = match hit {
            Some((distance, number, normal)) => {
                format!("\"distance\": {distance:?}, \"primitive\": {number}, \"normal\": {:?}", normal.0)
            }
            None => "\"distance\": null, \"primitive\": null".to_string(),
        };
        println!("{{\"path\": \"{path}\", {rays}, {colors}, {end}}}");
    }
}

/// The distance to a primitive, or infinity.
fn meet(ray: &Ray, shape: &Shape, is_own: bool) -> f64 {
    match shape {
        Shape::Sphere { center, radius } => meet_sphere(ray, *center, *radius, is_own),
        Shape::Triangle { .. } | Shape::Plane { .. } if is_own => INFINITY, // TRI-3, PLANE-3
        Shape::Triangle { a, ab, ac, .. } => meet_triangle(ray, *a, *ab, *ac),
        Shape::Plane { point, normal } => meet_plane(ray, *point, *normal),
    }
}

/// Textbook quadratic: t² + 2bt + c = 0.
fn meet_sphere(ray: &Ray, center: Vec3, radius: f64, is_own: bool) -> f64 {
    let from_center = ray.origin - center;
    let b = ray.direction.dot(from_center);
    if is_own {
        return if b < 0.0 { -2.0 * b } else { INFINITY }; // SPH-4
    }
    let discriminant = b * b - (from_center.dot(from_center) - radius * radius);
    if discriminant < 0.0 {
        return INFINITY; // SPH-2
    }
    let root = discriminant.sqrt();
    if -b - root > 0.0 {
        return -b - root; // SPH-1
    }
    if -b + root > 0.0 { -b + root } else { INFINITY }
}

/// Möller and Trumbore 1997. TRI-1, TRI-2.
fn meet_triangle(ray: &Ray, a: Vec3, ab: Vec3, ac: Vec3) -> f64 {
    let p = ray.direction.cross(ac);
    let determinant = ab.dot(p);
    if determinant == 0.0 {
        return INFINITY;
    }
    let s = ray.origin - a;
    let u = s.dot(p) / determinant;
    if u < 0.0 || u > 1.0 {
        return INFINITY;
    }
    let q = s.cross(ab);
    let v = ray.direction.dot(q) / determinant;
    if v < 0.0 || u + v > 1.0 {
        return INFINITY;
    }
    let distance = ac.dot(q) / determinant;
    if distance > 0.0 { distance } else { INFINITY }
}

/// PLANE-1, PLANE-2.
fn meet_plane(ray: &Ray, point: Vec3, normal: Vec3) -> f64 {
    let along = ray.direction.dot(normal);
    let distance = (point - ray.origin).dot(normal) / along;
    if along != 0.0 && distance > 0.0 { distance } else { INFINITY }
}

impl Scene {
    /// Distances to all primitives that the ray meets, with their numbers.
    fn hits<'a>(&'a self, ray: &'a Ray) -> impl Iterator<Item = (f64, usize)> + 'a {
        let met = |(number, primitive): (usize, &scene::Primitive)| {
            (meet(ray, &primitive.shape, ray.leaves == Some(number)), number)
        };
        self.primitives.iter().enumerate().map(met).filter(|hit| hit.0 < INFINITY)
    }

    /// TRAV-1, TRAV-3: of equals the first stays.
    fn first_hit(&self, ray: &Ray) -> Option<(f64, usize)> {
        self.hits(ray).reduce(|nearest, hit| if hit.0 < nearest.0 { hit } else { nearest })
    }

    /// Whether anything lies between the ray's start and the light. SHAD-1 to SHAD-4.
    fn is_hidden(&self, to_light: &Ray, light_distance: f64) -> bool {
        self.hits(to_light).any(|hit| hit.0 < light_distance)
    }

    /// BG-1.
    fn background(&self, direction: Vec3) -> Vec3 {
        let k = (direction.0[1] + 1.0) / 2.0;
        (1.0 - k) * self.bottom + k * self.top
    }

    /// What one light adds where the ray hits primitive `number` and `reflected` starts.
    /// The normal is turned to the ray's origin.
    fn lit_by(&self, light: &Light, ray: &Ray, reflected: &Ray, normal: Vec3, number: usize) -> Vec3 {
        let material = &self.materials[self.primitives[number].material];
        let point = reflected.origin;
        let (to_light, distance, strength) = match light.source {
            Source::Directional { direction } => (-direction, INFINITY, 1.0),
            Source::Point { position } => {
                let way = position - point;
                let distance = way.length();
                if distance == 0.0 {
                    return Vec3::default(); // ILL-9
                }
                (way / distance, distance, attenuation(light, distance))
            }
        };
        let cosine = normal.dot(to_light);
        let shadow_ray = Ray { origin: point, direction: to_light, leaves: reflected.leaves, path: None };
        if cosine <= 0.0 || self.is_hidden(&shadow_ray, distance) {
            return Vec3::default(); // ILL-2
        }
        let mut weight = Vec3::default();
        if let Some(diffuse) = &material.diffuse {
            weight = (if self.is_radiometric { cosine / PI } else { cosine }) * diffuse.at(point); // ILL-2, ILL-3
        }
        if let Some(specular) = &material.specular {
            let highlight = if specular.is_blinn {
                normal.dot((to_light - ray.direction).unit()) // ILL-6
            } else {
                reflected.direction.dot(to_light) // ILL-5
            };
            weight = weight + highlight.max(0.0).powf(specular.exponent) * specular.reflectance;
        }
        strength * (weight * light.intensity)
    }

    /// The light that comes back along a ray which has `depth` reflections and refractions left. TREE.
    fn radiance(&self, ray: &Ray, medium: Option<usize>, depth: usize) -> Vec3 {
        let Some((distance, number)) = self.first_hit(ray) else {
            let seen = self.background(ray.direction); // BG-3: not absorbed
            ray.note(None, seen, seen);
            return seen;
        };
        let primitive = &self.primitives[number];
        let point = ray.origin + distance * ray.direction;
        let own_normal = match primitive.shape {
            Shape::Sphere { center, .. } => (point - center).unit(), // SPH-5
            Shape::Triangle { normal, .. } | Shape::Plane { normal, .. } => normal,
        };
        let enters = ray.direction.dot(own_normal) < 0.0; // ILL-1
        let normal = if enters { own_normal } else { -own_normal };
        let mirror_direction = ray.direction - 2.0 * ray.direction.dot(normal) * normal; // REFL-1
        let reflected = Ray { origin: point, direction: mirror_direction, leaves: Some(number), path: ray.then('M') };

        let material = &self.materials[primitive.material];
        let mut sum = Vec3::default();
        if let Some(emission) = &material.emission {
            sum = sum + emission.at(point);
        }
        if let Some(ambient) = material.ambient {
            sum = sum + ambient * self.ambient_light;
        }
        if material.diffuse.is_some() || material.specular.is_some() {
            for light in &self.lights {
                sum = sum + self.lit_by(light, ray, &reflected, normal, number);
            }
        }
        let local = sum;
        if depth > 0 {
            if let Some(mirror) = material.mirror {
                sum = sum + mirror * self.radiance(&reflected, medium, depth - 1); // REFL-2
            }
            if material.dielectric.is_some() {
                sum = sum + self.through(ray, &reflected, normal, enters, medium, depth, primitive.material);
            }
        }
        if let Some(sigma) = medium.and_then(|number| self.materials[number].dielectric.as_ref()?.absorption) {
            sum = sum * sigma.map(|sigma| (-sigma * distance).exp()); // REFR-7
        }
        ray.note(Some((distance, number, normal)), local, sum);
        sum
    }

    /// What a dielectric, of material `number`, reflects and refracts. The normal is turned to the ray's origin. REFR.
    #[allow(clippy::too_many_arguments)]
    fn through(
        &self, ray: &Ray, reflected: &Ray, normal: Vec3, enters: bool, medium: Option<usize>, depth: usize, number: usize,
    ) -> Vec3 {
        let glass = self.materials[number].dielectric.as_ref().unwrap();
        let outer = glass.outside.map_or(1.0, |outside| self.materials[outside].dielectric.as_ref().unwrap().index);
        let eta = if enters { glass.index / outer } else { outer / glass.index }; // REFR-1
        let c = -ray.direction.dot(normal);
        let g_squared = eta * eta - 1.0 + c * c; // REFR-2
        let Ray { origin, direction, leaves, .. } = *reflected;
        let mirrored = self.radiance(&Ray { origin, direction, leaves, path: ray.then('R') }, medium, depth - 1);
        if g_squared < 0.0 {
            return glass.reflectance.map_or(mirrored, |reflectance| reflectance * mirrored); // REFR-5, REFR-6
        }
        let g = g_squared.sqrt();
        let (r_s, r_p) = ((c - g) / (c + g), (eta * eta * c - g) / (eta * eta * c + g));
        let fresnel = if c > 0.0 { (r_s * r_s + r_p * r_p) / 2.0 } else { 1.0 }; // REFR-4
        let transmitted = if self.is_radiometric { (1.0 - fresnel) / (eta * eta) } else { 1.0 - fresnel };
        let direction = (ray.direction + (c - g) * normal) / eta; // REFR-3
        let refracted = Ray { origin, direction, leaves, path: ray.then('T') };
        let beyond = if enters { Some(number) } else { glass.outside }; // REFR-9
        let behind = self.radiance(&refracted, beyond, depth - 1);
        glass.reflectance.unwrap_or(Vec3([fresnel; 3])) * mirrored
            + glass.transmittance.unwrap_or(Vec3([transmitted; 3])) * behind // REFR-6
    }
}

/// How a point light weakens with distance: ILL-7, and 1/d² of ILL-3.
fn attenuation(light: &Light, distance: f64) -> f64 {
    let [constant, linear, quadratic] = light.falloff;
    let divisor = constant + linear * distance + quadratic * distance * distance;
    if light.is_clamped && divisor <= 1.0 { 1.0 } else { 1.0 / divisor }
}

/// The ray through the centre of a pixel. CAM-3, CAM-4, IMG-1.
fn camera_ray(camera: &Camera, column: usize, row: usize) -> Ray {
    let x = (column as f64 + 0.5 - camera.width as f64 / 2.0) * camera.pixel;
    let y = (row as f64 + 0.5 - camera.height as f64 / 2.0) * camera.pixel;
    let across = x * camera.right + y * camera.down;
    if camera.is_perspective {
        Ray { origin: camera.position, direction: (camera.forward + across).unit(), leaves: None, path: None }
    } else {
        Ray { origin: camera.position + across, direction: camera.forward, leaves: None, path: None }
    }
}

fn usage() -> ! {
    eprintln!("usage: tracer SCENE.json OUTPUT.pfm [--trace COLUMN ROW]");
    std::process::exit(2);
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let [_, scene_file, output, trace @ ..] = arguments.as_slice() else { usage() };
    let scene = scene::load(scene_file.as_ref());
    let camera = &scene.camera;
    match trace {
        [] => (),
        [option, column, row] if option == "--trace" => {
            let [column, row] = [column, row].map(|text| text.parse().unwrap_or_else(|_| usage()));
            let ray = Ray { path: Some(String::new()), ..camera_ray(camera, column, row) };
            scene.radiance(&ray, camera.inside, scene.max_depth);
            return;
        }
        _ => usage(),
    }
    let mut file = format!("PF\n{} {}\n-1.0\n", camera.width, camera.height).into_bytes(); // minus: little endian
    for row in (0..camera.height).rev() {
        // a PFM begins with the bottom row
        for column in 0..camera.width {
            let color = scene.radiance(&camera_ray(camera, column, row), camera.inside, scene.max_depth);
            for channel in color.0 {
                file.extend((channel as f32).to_le_bytes());
            }
        }
    }
    std::fs::write(output, file).expect("the image cannot be written");
}
