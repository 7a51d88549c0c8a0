// A Whitted ray tracer, written to raytruth's docs/spec.md, whose clauses are named behind the lines they belong to.
//
//     tracer SCENE.json OUTPUT.pfm
//
// -DREAL=float computes in float32. -DEPSILON=1e-3 keeps a ray from the surface that it leaves by a least distance,
// as many tracers do; without it the surface is left out by its number, as the specification has it.
#include <cstdio>

#include "scene.hpp"

static Scene scene;
const int NOTHING = -1;

struct Ray {
    Vec origin, direction;  // the direction is a unit vector
    int leaves = NOTHING;   // the primitive on whose surface the ray starts
};
struct Hit {
    real distance;
    int primitive;  // all spheres are numbered first, then all triangles, then all planes (TRAV-2)
};

real least_distance(const Ray& ray) {
#ifdef EPSILON
    return ray.leaves == NOTHING ? 0 : real(EPSILON);
#else
    (void)ray;
    return 0;
#endif
}

bool is_own(const Ray& ray, int primitive) {
#ifdef EPSILON
    (void)ray, (void)primitive;
    return false;
#else
    return ray.leaves == primitive;
#endif
}

// The distance to a sphere, or FAR. Textbook quadratic: t² + 2bt + c = 0.
real meet(const Ray& ray, const Sphere& sphere, bool own) {
    Vec from_center = ray.origin - sphere.center;
    real b = dot(ray.direction, from_center), least = least_distance(ray);
    if (own) return b < 0 ? -2 * b : FAR;  // SPH-4
    real c = dot(from_center, from_center) - sphere.radius * sphere.radius;
    real discriminant = b * b - c;
    if (discriminant < 0) return FAR;  // SPH-2
    real root = std::sqrt(discriminant);
    if (-b - root > least) return -b - root;  // SPH-1
    return -b + root > least ? -b + root : FAR;
}

// The distance to a triangle, or FAR (Möller and Trumbore 1997). TRI-1 to TRI-3.
real meet(const Ray& ray, const Triangle& triangle, bool own) {
    Vec p = cross(ray.direction, triangle.ac);
    real determinant = dot(triangle.ab, p);
    if (own || determinant == 0) return FAR;
    Vec s = ray.origin - triangle.a;
    real u = dot(s, p) / determinant;
    if (u < 0 || u > 1) return FAR;
    Vec q = cross(s, triangle.ab);
    real v = dot(ray.direction, q) / determinant;
    if (v < 0 || u + v > 1) return FAR;
    real distance = dot(triangle.ac, q) / determinant;
    return distance > least_distance(ray) ? distance : FAR;
}

// The distance to a plane, or FAR. PLANE-1 to PLANE-3.
real meet(const Ray& ray, const Plane& plane, bool own) {
    real along = dot(ray.direction, plane.normal);
    if (own || along == 0) return FAR;
    real distance = dot(plane.point - ray.origin, plane.normal) / along;
    return distance > least_distance(ray) ? distance : FAR;
}

// The nearest hit that is nearer than `limit`. TRAV-1, TRAV-3: the first of equals stays.
Hit first_hit(const Ray& ray, real limit = FAR) {
    Hit hit{limit, NOTHING};
    int number = 0;
    auto search = [&](const auto& shapes) {
        for (const auto& shape : shapes) {
            real distance = meet(ray, shape, is_own(ray, number));
            if (distance < hit.distance) hit = {distance, number};
            ++number;
        }
    };
    search(scene.spheres), search(scene.triangles), search(scene.planes);
    return hit;
}

bool is_hidden(const Ray& to_light, real light_distance) {  // SHAD-1 to SHAD-4
    return first_hit(to_light, light_distance).primitive != NOTHING;
}

Vec background(Vec direction) {  // BG-1
    real k = (direction.y + 1) / 2;
    return (1 - k) * scene.bottom + k * scene.top;
}

real attenuation(const Light& light, real distance) {  // ILL-7; in radiometric scenes 1/d² of ILL-3
    real divisor = light.constant + light.linear * distance + light.quadratic * distance * distance;
    if (light.clamped && divisor <= 1) return 1;
    return 1 / divisor;
}

// What one light adds at `point`, whose `normal` is turned to the viewer. `reflected` is the mirror direction.
Vec lit_by(const Light& light, Vec point, Vec normal, Vec view, Vec reflected, const Material& material, int primitive) {
    Vec way = light.directional ? -light.direction : light.position - point;
    real distance = light.directional ? FAR : length(way);
    if (distance == 0) return {};  // ILL-9
    Vec to_light = light.directional ? way : way / distance;
    real cosine = dot(normal, to_light);
    if (cosine <= 0 || is_hidden({point, to_light, primitive}, distance)) return {};  // ILL-2
    Vec weight;
    if (material.diffuse) {
        Vec reflectance = material.diffuse->at(point);
        weight = cosine * (scene.radiometric ? reflectance / PI : reflectance);  // ILL-3
    }
    if (material.specular) {  // ILL-5, ILL-6
        real highlight = material.specular->blinn ? dot(normal, unit(to_light - view)) : dot(reflected, to_light);
        if (highlight > 0) weight = weight + std::pow(highlight, material.specular->exponent) * material.specular->reflectance;
    }
    return (light.directional ? 1 : attenuation(light, distance)) * (weight * light.intensity);
}

Vec radiance(const Ray& ray, const Material* medium, int depth);

// What a dielectric reflects and refracts (REFR). `normal` is turned to the ray's origin.
Vec through(const Ray& ray, const Material& material, bool enters, Vec normal, const Ray& reflected,
            const Material* medium, int depth) {
    const Dielectric& glass = *material.dielectric;
    real outer = glass.outside ? glass.outside->dielectric->index : 1;
    real eta = enters ? glass.index / outer : outer / glass.index;  // REFR-1
    real c = -dot(ray.direction, normal);
    real g_squared = eta * eta - 1 + c * c;  // REFR-2
    Vec mirrored = radiance(reflected, medium, depth - 1);
    if (g_squared < 0) return glass.reflectance ? *glass.reflectance * mirrored : mirrored;  // REFR-5, REFR-6
    real g = std::sqrt(g_squared);
    real r_s = (c - g) / (c + g), r_p = (eta * eta * c - g) / (eta * eta * c + g);
    real fresnel = c > 0 ? (r_s * r_s + r_p * r_p) / 2 : 1;  // REFR-4
    real scale = scene.radiometric ? 1 / (eta * eta) : 1;
    Vec transmittance = scale * (1 - fresnel) * Vec{1, 1, 1}, reflectance = fresnel * Vec{1, 1, 1};
    if (glass.reflectance) reflectance = *glass.reflectance, transmittance = *glass.transmittance;  // REFR-6
    Ray refracted{reflected.origin, (ray.direction + (c - g) * normal) / eta, reflected.leaves};  // REFR-3
    const Material* beyond = enters ? &material : glass.outside;  // REFR-9
    return reflectance * mirrored + transmittance * radiance(refracted, beyond, depth - 1);
}

// The radiance that comes back along the ray, which has `depth` reflections and refractions left (TREE).
Vec radiance(const Ray& ray, const Material* medium, int depth) {
    Hit hit = first_hit(ray);
    if (hit.primitive == NOTHING) return background(ray.direction);  // BG-3: not absorbed
    Vec point = ray.origin + hit.distance * ray.direction;
    const Material* found;
    Vec normal;  // the shape's own
    int spheres = int(scene.spheres.size()), triangles = int(scene.triangles.size());
    if (hit.primitive < spheres) {
        const Sphere& sphere = scene.spheres[hit.primitive];
        // SPH-5; a unit vector whatever the rounding, since errors of its length grow with each reflection.
        found = sphere.material, normal = unit(point - sphere.center);
    } else if (hit.primitive < spheres + triangles) {
        const Triangle& triangle = scene.triangles[hit.primitive - spheres];
        found = triangle.material, normal = unit(cross(triangle.ab, triangle.ac));  // TRI-4
    } else {
        const Plane& plane = scene.planes[hit.primitive - spheres - triangles];
        found = plane.material, normal = plane.normal;
    }
    const Material& material = *found;
    bool enters = dot(ray.direction, normal) < 0;  // ILL-1
    if (!enters) normal = -normal;
    Ray reflected{point, ray.direction - 2 * dot(ray.direction, normal) * normal, hit.primitive};  // REFL-1

    Vec sum;
    if (material.emission) sum = sum + material.emission->at(point);
    if (material.ambient) sum = sum + *material.ambient * scene.ambient_light;
    if (material.diffuse || material.specular)
        for (const Light& light : scene.lights)
            sum = sum + lit_by(light, point, normal, ray.direction, reflected.direction, material, hit.primitive);
    if (depth > 0 && material.mirror) sum = sum + *material.mirror * radiance(reflected, medium, depth - 1);  // REFL-2
    if (depth > 0 && material.dielectric)
        sum = sum + through(ray, material, enters, normal, reflected, medium, depth);

    if (!medium || !medium->dielectric->absorption) return sum;
    Vec sigma = *medium->dielectric->absorption;  // REFR-7
    return sum * Vec{std::exp(-sigma.x * hit.distance), std::exp(-sigma.y * hit.distance), std::exp(-sigma.z * hit.distance)};
}

Ray camera_ray(int column, int row) {  // CAM-3, CAM-4, IMG-1
    const Camera& camera = scene.camera;
    real x = (column + real(0.5) - real(camera.width) / 2) * camera.pixel;
    real y = (row + real(0.5) - real(camera.height) / 2) * camera.pixel;
    Vec across = x * camera.right + y * camera.down;
    if (camera.perspective) return {camera.position, unit(camera.forward + across)};
    return {camera.position + across, camera.forward};
}

int main(int count, char** arguments) try {
    if (count != 3) throw std::runtime_error("usage: tracer SCENE.json OUTPUT.pfm");
    load(arguments[1], scene);
    std::vector<float> image;
    for (int row = scene.camera.height - 1; row >= 0; --row)  // a PFM begins with the bottom row
        for (int column = 0; column < scene.camera.width; ++column) {
            Vec color = radiance(camera_ray(column, row), scene.camera.inside, scene.max_depth);
            image.insert(image.end(), {float(color.x), float(color.y), float(color.z)});
        }
    std::ofstream file(arguments[2], std::ios::binary);
    file << "PF\n" << scene.camera.width << " " << scene.camera.height << "\n-1.0\n";  // negative: little endian
    file.write(reinterpret_cast<const char*>(image.data()), std::streamsize(image.size() * sizeof(float)));
    if (!file.flush()) throw std::runtime_error(std::string(arguments[2]) + " cannot be written");
    return 0;
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
