//! What a scene is, and how it is read from its file (docs/scene-format.md).

use crate::json::Json;
use std::collections::HashMap;
use std::f64::consts::PI;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::path::Path;

/// A point, a direction, or a colour.
#[derive(Clone, Copy, Default)]
pub struct Vec3(pub [f64; 3]);

impl Vec3 {
    pub fn dot(self, b: Vec3) -> f64 {
        self.0[0] * b.0[0] + self.0[1] * b.0[1] + self.0[2] * b.0[2]
    }
    pub fn cross(self, b: Vec3) -> Vec3 {
        let ([x, y, z], [u, v, w]) = (self.0, b.0);
        Vec3([y * w - z * v, z * u - x * w, x * v - y * u])
    }
    pub fn length(self) -> f64 {
        self.dot(self).sqrt()
    }
    pub fn unit(self) -> Vec3 {
        self / self.length()
    }
    pub fn map(self, function: impl Fn(f64) -> f64) -> Vec3 {
        Vec3(self.0.map(function))
    }
}
impl Add for Vec3 {
    type Output = Vec3;
    fn add(self, b: Vec3) -> Vec3 {
        Vec3([self.0[0] + b.0[0], self.0[1] + b.0[1], self.0[2] + b.0[2]])
    }
}
impl Sub for Vec3 {
    type Output = Vec3;
    fn sub(self, b: Vec3) -> Vec3 {
        Vec3([self.0[0] - b.0[0], self.0[1] - b.0[1], self.0[2] - b.0[2]])
    }
}
impl Mul for Vec3 {
    type Output = Vec3; // of two colours, channel by channel
    fn mul(self, b: Vec3) -> Vec3 {
        Vec3([self.0[0] * b.0[0], self.0[1] * b.0[1], self.0[2] * b.0[2]])
    }
}
impl Mul<Vec3> for f64 {
    type Output = Vec3;
    fn mul(self, a: Vec3) -> Vec3 {
        a.map(|x| self * x)
    }
}
impl Div<f64> for Vec3 {
    type Output = Vec3;
    fn div(self, k: f64) -> Vec3 {
        self.map(|x| x / k)
    }
}
impl Neg for Vec3 {
    type Output = Vec3;
    fn neg(self) -> Vec3 {
        self.map(|x| -x)
    }
}

/// A checkerboard, or one colour on all of its squares.
pub struct Texture {
    even: Vec3,
    odd: Vec3,
    size: f64,
    axes: [usize; 2],
    offset: [f64; 2],
}

impl Texture {
    /// The colour at a point of a surface: TEX-1, TEX-2.
    pub fn at(&self, point: Vec3) -> Vec3 {
        let square = |i: usize| ((point.0[self.axes[i]] - self.offset[i]) / self.size).floor();
        if (square(0) + square(1)) % 2.0 == 0.0 { self.even } else { self.odd }
    }
}

pub struct Specular {
    pub reflectance: Vec3,
    pub exponent: f64,
    pub is_blinn: bool,
}

pub struct Dielectric {
    pub index: f64,
    pub absorption: Option<Vec3>,
    pub reflectance: Option<Vec3>,
    pub transmittance: Option<Vec3>,
    pub outside: Option<usize>, // a material's number; none: empty space
}

pub struct Material {
    pub ambient: Option<Vec3>,
    pub diffuse: Option<Texture>,
    pub specular: Option<Specular>,
    pub mirror: Option<Vec3>,
    pub emission: Option<Texture>,
    pub dielectric: Option<Dielectric>,
}

pub enum Shape {
    Sphere { center: Vec3, radius: f64 },
    /// A corner, the way from it to the other two, and the shape's own normal.
    Triangle { a: Vec3, ab: Vec3, ac: Vec3, normal: Vec3 },
    Plane { point: Vec3, normal: Vec3 },
}

pub struct Primitive {
    pub shape: Shape,
    pub material: usize,
}

pub enum Source {
    Point { position: Vec3 },
    Directional { direction: Vec3 },
}

pub struct Light {
    pub source: Source,
    pub intensity: Vec3, // or irradiance
    /// The divisor is falloff[0] + falloff[1]·d + falloff[2]·d².
    pub falloff: [f64; 3],
    pub is_clamped: bool,
}

pub struct Camera {
    pub position: Vec3,
    pub forward: Vec3,
    pub right: Vec3,
    pub down: Vec3,
    pub is_perspective: bool,
    pub pixel: f64, // size on the image plane
    pub width: usize,
    pub height: usize,
    pub inside: Option<usize>,
}

pub struct Scene {
    pub is_radiometric: bool,
    pub max_depth: usize,
    pub camera: Camera,
    pub bottom: Vec3, // of the background
    pub top: Vec3,
    pub ambient_light: Vec3,
    pub lights: Vec<Light>,
    pub materials: Vec<Material>,
    pub primitives: Vec<Primitive>, // all spheres, then all triangles, then all planes: TRAV-2
}

type Numbers<'a> = HashMap<&'a str, usize>; // of materials

pub fn load(path: &Path) -> Scene {
    let text = std::fs::read_to_string(path).expect("the scene file cannot be read");
    let json = Json::read(&text);
    let named: Vec<(&String, &Json)> = json.at("materials").members().iter().collect();
    let numbers: Numbers = named.iter().enumerate().map(|(number, (name, _))| (name.as_str(), number)).collect();
    let background = |key| json.get("background").map_or(Vec3::default(), |b| vec(b.get("color").unwrap_or_else(|| b.at(key))));
    let mut primitives: Vec<Primitive> =
        json.at("objects").list().iter().flat_map(|object| shapes(object, path, &numbers)).collect();
    primitives.sort_by_key(|primitive| match primitive.shape {
        Shape::Sphere { .. } => 0,
        Shape::Triangle { .. } => 1,
        Shape::Plane { .. } => 2,
    }); // which leaves those of one kind in their order
    Scene {
        is_radiometric: json.at("convention").text() == "radiometric",
        max_depth: json.get("max_depth").map_or(0, |depth| depth.number() as usize),
        camera: camera(json.at("camera"), &numbers),
        bottom: background("bottom"),
        top: background("top"),
        ambient_light: json.get("ambient_light").map_or(Vec3::default(), vec),
        lights: json.get("lights").map_or(vec![], |lights| lights.list().iter().map(light).collect()),
        materials: named.iter().map(|(_, terms)| material(terms, &numbers)).collect(),
        primitives,
    }
}

fn vec(json: &Json) -> Vec3 {
    let list = json.list();
    Vec3([list[0].number(), list[1].number(), list[2].number()])
}

fn camera(json: &Json, numbers: &Numbers) -> Camera {
    let position = vec(json.at("position"));
    let forward = (vec(json.at("look_at")) - position).unit(); // CAM-1
    let right = forward.cross(json.get("up").map_or(Vec3([0.0, 1.0, 0.0]), vec)).unit();
    let is_perspective = json.at("projection").text() == "perspective";
    let view_height = if is_perspective {
        2.0 * (json.at("vertical_field_of_view").number() * PI / 360.0).tan() // CAM-3, at the distance 1
    } else {
        json.at("view_height").number() // CAM-4
    };
    Camera {
        position,
        forward,
        right,
        down: forward.cross(right),
        is_perspective,
        pixel: view_height / json.at("height").number(),
        width: json.at("width").number() as usize,
        height: json.at("height").number() as usize,
        inside: json.get("inside").map(|name| numbers[name.text()]),
    }
}

fn light(json: &Json) -> Light {
    if json.at("kind").text() == "directional" {
        let source = Source::Directional { direction: vec(json.at("direction")).unit() };
        return Light { source, intensity: vec(json.at("irradiance")), falloff: [1.0, 0.0, 0.0], is_clamped: false };
    }
    let stated = json.at("falloff");
    let (falloff, is_clamped) = match stated {
        Json::Text(name) if name == "none" => ([1.0, 0.0, 0.0], false),
        Json::Text(_) => ([0.0, 0.0, 1.0], false),
        _ => (["constant", "linear", "quadratic"].map(|key| stated.at(key).number()), true),
    };
    let source = Source::Point { position: vec(json.at("position")) };
    Light { source, intensity: vec(json.at("intensity")), falloff, is_clamped }
}

fn texture(json: &Json) -> Texture {
    let Some(board) = json.get("checkerboard") else {
        return Texture { even: vec(json), odd: vec(json), size: 1.0, axes: [0, 2], offset: [0.0, 0.0] };
    };
    let plane = board.get("plane").map_or("xz", |plane| plane.text()).as_bytes();
    let offset = |i: usize| board.get("offset").map_or(0.0, |offset| offset.list()[i].number());
    Texture {
        even: vec(board.at("even")),
        odd: vec(board.at("odd")),
        size: board.get("size").map_or(1.0, |size| size.number()),
        axes: [0, 1].map(|i| (plane[i] - b'x') as usize),
        offset: [0, 1].map(offset),
    }
}

fn material(json: &Json, numbers: &Numbers) -> Material {
    Material {
        ambient: json.get("ambient").map(|term| vec(term.at("reflectance"))),
        diffuse: json.get("diffuse").map(|term| texture(term.at("reflectance"))),
        specular: json.get("specular").map(|term| Specular {
            reflectance: vec(term.at("reflectance")),
            exponent: term.at("exponent").number(),
            is_blinn: term.at("model").text() == "blinn",
        }),
        mirror: json.get("mirror").map(|term| vec(term.at("reflectance"))),
        emission: json.get("emission").map(|term| texture(term.at("radiance"))),
        dielectric: json.get("dielectric").map(|term| Dielectric {
            index: term.at("index_of_refraction").number(),
            absorption: term.get("absorption").map(vec),
            reflectance: term.get("reflectance").map(vec),
            transmittance: term.get("transmittance").map(vec),
            outside: term.get("outside").map(|name| numbers[name.text()]),
        }),
    }
}

fn shapes(json: &Json, scene_file: &Path, numbers: &Numbers) -> Vec<Primitive> {
    let shapes = match json.at("shape").text() {
        "sphere" => vec![Shape::Sphere { center: vec(json.at("center")), radius: json.at("radius").number() }],
        "plane" => vec![Shape::Plane { point: vec(json.at("point")), normal: vec(json.at("normal")).unit() }], // PLANE-4
        _ => triangles(json, scene_file),
    };
    let material = numbers[json.at("material").text()];
    shapes.into_iter().map(|shape| Primitive { shape, material }).collect()
}

fn triangles(json: &Json, scene_file: &Path) -> Vec<Shape> {
    let (vertices, faces) = match json.get("file") {
        Some(file) => read_obj(&scene_file.with_file_name(file.text())),
        None => {
            let indices = |face: &Json| face.list().iter().map(|number| number.number() as usize).collect();
            let faces = json.get("faces").map(|faces| faces.list().iter().map(indices).collect());
            (json.at("vertices").list().iter().map(vec).collect(), faces.unwrap_or(vec![vec![0, 1, 2]]))
        }
    };
    let mut result = Vec::new();
    for face in faces {
        let a = vertices[face[0]];
        for pair in face[1..].windows(2) {
            // a face of more corners is a fan
            let (ab, ac) = (vertices[pair[0]] - a, vertices[pair[1]] - a);
            result.push(Shape::Triangle { a, ab, ac, normal: ab.cross(ac).unit() }); // TRI-4
        }
    }
    result
}

/// The corners and faces of an OBJ file, of the kind that raytruth writes beside very large scenes.
fn read_obj(path: &Path) -> (Vec<Vec3>, Vec<Vec<usize>>) {
    let (mut vertices, mut faces) = (Vec::new(), Vec::new());
    for line in std::fs::read_to_string(path).expect("the mesh file cannot be read").lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        if words.first() == Some(&"v") {
            vertices.push(Vec3([1, 2, 3].map(|i| words[i].parse().expect("a coordinate is expected"))));
        } else if words.first() == Some(&"f") {
            // 7, 7/1 or 7/1/3: counted from 1; or -1, backwards from the last vertex
            let number = |word: &&str| word.split('/').next().unwrap().parse::<i64>().expect("a number is expected");
            let place = |n: i64| (if n > 0 { n - 1 } else { n + vertices.len() as i64 }) as usize;
            faces.push(words[1..].iter().map(number).map(place).collect());
        }
    }
    (vertices, faces)
}
