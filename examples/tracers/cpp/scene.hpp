// What a scene is, and how it is read from its file (docs/scene-format.md).
#pragma once
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "json.hpp"

#ifndef REAL
#define REAL double
#endif
using real = REAL;  // the arithmetic of the whole tracer: g++ -DREAL=float
const real FAR = std::numeric_limits<real>::max(), PI = real(3.14159265358979323846L);

struct Vec {  // a point, a direction, or a colour
    real x = 0, y = 0, z = 0;
    real operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};
inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec operator-(Vec a) { return {-a.x, -a.y, -a.z}; }
inline Vec operator*(Vec a, Vec b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }  // channel by channel
inline Vec operator*(real k, Vec a) { return {k * a.x, k * a.y, k * a.z}; }
inline Vec operator/(Vec a, real k) { return {a.x / k, a.y / k, a.z / k}; }
inline real dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline real length(Vec a) { return std::sqrt(dot(a, a)); }
inline Vec unit(Vec a) { return a / length(a); }
inline Vec cross(Vec a, Vec b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct Texture {  // a checkerboard, or one colour on all of its squares
    Vec even, odd;
    real size = 1, offset[2] = {0, 0};
    int axes[2] = {0, 2};

    Vec at(Vec point) const {  // TEX-1, TEX-2
        real squares = 0;
        for (int i : {0, 1}) squares += std::floor((point[axes[i]] - offset[i]) / size);
        return std::fmod(squares, real(2)) == 0 ? even : odd;
    }
};

struct Specular {
    Vec reflectance;
    real exponent;
    bool blinn;
};
struct Material;
struct Dielectric {
    real index;
    std::optional<Vec> absorption, reflectance, transmittance;
    const Material* outside = nullptr;  // null: empty space
};
struct Material {
    std::optional<Vec> ambient, mirror;
    std::optional<Texture> diffuse, emission;
    std::optional<Specular> specular;
    std::optional<Dielectric> dielectric;
};

struct Sphere {
    Vec center;
    real radius;
    const Material* material;
};
struct Triangle {
    Vec a, ab, ac;  // a corner, and the way from it to the other two
    const Material* material;
};
struct Plane {
    Vec point, normal;
    const Material* material;
};
struct Light {
    bool directional;
    Vec position, direction;  // of a point light, of a directional light
    Vec intensity;            // or irradiance
    real constant, linear, quadratic;
    bool clamped;  // a polynomial falloff is at most 1
};
struct Camera {
    Vec position, forward, right, down;
    bool perspective;
    real pixel;  // size of a pixel on the image plane
    int width, height;
    const Material* inside = nullptr;
};
struct Scene {
    bool radiometric;
    int max_depth = 0;
    Camera camera;
    Vec bottom, top;  // of the background
    Vec ambient_light;
    std::vector<Light> lights;
    std::map<std::string, Material> materials;
    std::vector<Sphere> spheres;
    std::vector<Triangle> triangles;
    std::vector<Plane> planes;
};

inline Vec vec(const Json& json) {
    return {real(json.list[0].number), real(json.list[1].number), real(json.list[2].number)};
}

inline std::optional<Vec> optional_vec(const Json& json, const char* key) {
    return json.has(key) ? std::optional(vec(json[key])) : std::nullopt;
}

inline Texture texture(const Json& json) {
    if (json.kind == Json::List) return {vec(json), vec(json)};
    const Json& board = json["checkerboard"];
    Texture result{vec(board["even"]), vec(board["odd"])};
    if (board.has("size")) result.size = real(board["size"].number);
    for (int i : {0, 1}) {
        if (board.has("offset")) result.offset[i] = real(board["offset"].list[i].number);
        if (board.has("plane")) result.axes[i] = board["plane"].text[i] - 'x';
    }
    return result;
}

inline Material material(const Json& json) {
    Material result;
    if (json.has("ambient")) result.ambient = vec(json["ambient"]["reflectance"]);
    if (json.has("diffuse")) result.diffuse = texture(json["diffuse"]["reflectance"]);
    if (json.has("emission")) result.emission = texture(json["emission"]["radiance"]);
    if (json.has("mirror")) result.mirror = vec(json["mirror"]["reflectance"]);
    if (json.has("specular")) {
        const Json& term = json["specular"];
        result.specular = Specular{vec(term["reflectance"]), real(term["exponent"].number), term["model"].text == "blinn"};
    }
    if (json.has("dielectric")) {
        const Json& term = json["dielectric"];
        result.dielectric = Dielectric{real(term["index_of_refraction"].number), optional_vec(term, "absorption"),
                                       optional_vec(term, "reflectance"), optional_vec(term, "transmittance")};
    }
    return result;
}

inline Light light(const Json& json) {
    if (json["kind"].text == "directional")
        return {true, {}, unit(vec(json["direction"])), vec(json["irradiance"]), 1, 0, 0, false};
    Light result{false, vec(json["position"]), {}, vec(json["intensity"]), 1, 0, 0, false};
    const Json& falloff = json["falloff"];
    if (falloff.kind == Json::Object) {
        result.constant = real(falloff["constant"].number);
        result.linear = real(falloff["linear"].number);
        result.quadratic = real(falloff["quadratic"].number);
        result.clamped = true;
    } else if (falloff.text == "inverse_square") {
        result.constant = 0;
        result.quadratic = 1;
    }
    return result;
}

inline Camera camera(const Json& json, const std::map<std::string, Material>& materials) {
    Camera result;
    result.position = vec(json["position"]);
    result.forward = unit(vec(json["look_at"]) - result.position);  // CAM-1
    result.right = unit(cross(result.forward, json.has("up") ? vec(json["up"]) : Vec{0, 1, 0}));
    result.down = cross(result.forward, result.right);
    result.width = int(json["width"].number);
    result.height = int(json["height"].number);
    result.perspective = json["projection"].text == "perspective";
    if (result.perspective) {  // CAM-3
        real half_angle = real(json["vertical_field_of_view"].number) * PI / 360;
        result.pixel = 2 * std::tan(half_angle) / result.height;
    } else {  // CAM-4
        result.pixel = real(json["view_height"].number) / result.height;
    }
    if (json.has("inside")) result.inside = &materials.at(json["inside"].text);
    return result;
}

inline std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error(path + " cannot be opened");
    return {std::istreambuf_iterator<char>(file), {}};
}

// The corners and faces of an OBJ file, of the kind that raytruth writes beside very large scenes.
inline void read_obj(const std::string& path, std::vector<Vec>& vertices, std::vector<std::vector<int>>& faces) {
    std::istringstream lines(text_of(path));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string word;
        words >> word;
        if (word == "v") {
            double x, y, z;
            words >> x >> y >> z;
            vertices.push_back({real(x), real(y), real(z)});
        } else if (word == "f") {
            faces.emplace_back();
            while (words >> word) {  // 7, 7/1 or 7/1/3: counted from 1; or -1, backwards from the last vertex
                int number = std::stoi(word);
                faces.back().push_back(number > 0 ? number - 1 : number + int(vertices.size()));
            }
        }
    }
}

inline void add_object(const Json& json, const std::string& folder, Scene& scene) {
    const Material* material = &scene.materials.at(json["material"].text);
    if (json["shape"].text == "sphere") {
        scene.spheres.push_back({vec(json["center"]), real(json["radius"].number), material});
        return;
    }
    if (json["shape"].text == "plane") {
        scene.planes.push_back({vec(json["point"]), unit(vec(json["normal"])), material});  // PLANE-4
        return;
    }
    std::vector<Vec> vertices;
    std::vector<std::vector<int>> faces;
    if (json.has("file")) {
        read_obj(folder + json["file"].text, vertices, faces);
    } else {
        for (const Json& vertex : json["vertices"].list) vertices.push_back(vec(vertex));
        if (json["shape"].text == "triangle") faces = {{0, 1, 2}};
        if (json.has("faces"))
            for (const Json& face : json["faces"].list) {
                faces.emplace_back();
                for (const Json& number : face.list) faces.back().push_back(int(number.number));
            }
    }
    for (const auto& face : faces)  // polygons as fans
        for (size_t i = 2; i < face.size(); ++i) {
            Vec a = vertices.at(face[0]), b = vertices.at(face[i - 1]), c = vertices.at(face[i]);
            scene.triangles.push_back({a, b - a, c - a, material});
        }
}

inline void load(const std::string& path, Scene& scene) {
    Json json = JsonReader::read(text_of(path));
    scene.radiometric = json["convention"].text == "radiometric";
    if (json.has("max_depth")) scene.max_depth = int(json["max_depth"].number);
    if (json.has("ambient_light")) scene.ambient_light = vec(json["ambient_light"]);
    if (json.has("background")) {
        const Json& background = json["background"];
        scene.bottom = vec(background[background.has("color") ? "color" : "bottom"]);
        scene.top = vec(background[background.has("color") ? "color" : "top"]);
    }
    for (const auto& [name, value] : json["materials"].members) scene.materials[name] = material(value);
    for (const auto& [name, value] : json["materials"].members)
        if (value.has("dielectric") && value["dielectric"].has("outside"))
            scene.materials[name].dielectric->outside = &scene.materials.at(value["dielectric"]["outside"].text);
    scene.camera = camera(json["camera"], scene.materials);
    if (json.has("lights"))
        for (const Json& value : json["lights"].list) scene.lights.push_back(light(value));
    std::string folder = path.substr(0, path.rfind('/') + 1);
    for (const Json& value : json["objects"].list) add_object(value, folder, scene);
}
