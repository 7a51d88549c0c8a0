import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;

/**
 * A Whitted ray tracer, written to raytruth's docs/spec.md, whose clauses are named beside the lines they belong to.
 *
 * <p>java Tracer SCENE.json OUTPUT.pfm, or with --trace COLUMN ROW behind it the rays of one pixel, for `raytruth trace`
 */
final class Tracer {
    /**
     * A half-line in a unit direction, the primitive on whose surface it starts, or null, and which mirrors (M),
     * reflections (R) and refractions (T) of glass it has come by.
     */
    record Ray(Scene.Vec origin, Scene.Vec direction, Scene.Primitive leaves, String path) {
        Ray by(char way) {
            return new Ray(origin, direction, leaves, path + way);
        }
    }

    /** The nearest hit; its primitive is null where nothing is hit. */
    record Hit(double distance, Scene.Primitive primitive) {
        Hit orNearer(double other, Scene.Primitive found) {
            return other < distance ? new Hit(other, found) : this;
        }
    }

    private static final double FAR = Double.POSITIVE_INFINITY;
    private final Scene scene;
    private final boolean isTraced;

    private Tracer(Scene scene, boolean isTraced) {
        this.scene = scene;
        this.isTraced = isTraced;
    }

    /** Print a ray and what came of it as a line of JSON, if the rays of a pixel are asked for. */
    private Scene.Vec noted(Ray ray, Hit hit, Scene.Vec normal, Scene.Vec local, Scene.Vec color) {
        if (isTraced)
            System.out.printf("{\"path\": \"%s\", \"origin\": %s, \"direction\": %s, \"local\": %s, \"color\": %s%s}%n",
                ray.path, json(ray.origin), json(ray.direction), json(local), json(color),
                hit.primitive == null
                    ? ", \"distance\": null"
                    : ", \"distance\": " + hit.distance + ", \"normal\": " + json(normal));
        return color;
    }

    private static String json(Scene.Vec v) {
        return "[" + v.x() + ", " + v.y() + ", " + v.z() + "]";
    }

    /** The distance to the sphere, or infinity. Textbook quadratic: t² + 2bt + c = 0. */
    private static double meet(Ray ray, Scene.Sphere sphere) {
        Scene.Vec fromCenter = ray.origin.minus(sphere.center());
        double b = ray.direction.dot(fromCenter);
        if (ray.leaves == sphere) return b < 0 ? -2 * b : FAR; // SPH-4
        double discriminant = b * b - (fromCenter.dot(fromCenter) - sphere.radius() * sphere.radius());
        if (discriminant < 0) return FAR; // SPH-2
        double root = Math.sqrt(discriminant);
        if (-b - root > 0) return -b - root; // SPH-1
        return -b + root > 0 ? -b + root : FAR;
    }

    /** The distance to the triangle, or infinity (Möller and Trumbore 1997). TRI-1 to TRI-3. */
    private static double meet(Ray ray, Scene.Triangle triangle) {
        if (ray.leaves == triangle) return FAR;
        Scene.Vec p = ray.direction.cross(triangle.ac());
        double determinant = triangle.ab().dot(p);
        if (determinant == 0) return FAR;
        Scene.Vec s = ray.origin.minus(triangle.a());
        double u = s.dot(p) / determinant;
        if (u < 0 || u > 1) return FAR;
        Scene.Vec q = s.cross(triangle.ab());
        double v = ray.direction.dot(q) / determinant;
        if (v < 0 || u + v > 1) return FAR;
        double distance = triangle.ac().dot(q) / determinant;
        return distance > 0 ? distance : FAR;
    }

    /** The distance to the plane, or infinity. PLANE-1 to PLANE-3. */
    private static double meet(Ray ray, Scene.Plane plane) {
        double along = ray.direction.dot(plane.normal());
        if (ray.leaves == plane || along == 0) return FAR;
        double distance = plane.point().minus(ray.origin).dot(plane.normal()) / along;
        return distance > 0 ? distance : FAR;
    }

    /** The nearest hit that is nearer than `limit`. TRAV-1, TRAV-3: of equals the first stays. */
    private Hit firstHit(Ray ray, double limit) {
        Hit hit = new Hit(limit, null);
        for (Scene.Sphere sphere : scene.spheres) hit = hit.orNearer(meet(ray, sphere), sphere);
        for (Scene.Triangle triangle : scene.triangles) hit = hit.orNearer(meet(ray, triangle), triangle);
        for (Scene.Plane plane : scene.planes) hit = hit.orNearer(meet(ray, plane), plane);
        return hit;
    }

    /** Whether anything lies between the ray's start and the light. SHAD-1 to SHAD-4. */
    private boolean isHidden(Ray toLight, double lightDistance) {
        return firstHit(toLight, lightDistance).primitive != null;
    }

    /** BG-1. */
    private Scene.Vec background(Scene.Vec direction) {
        double k = (direction.y() + 1) / 2;
        return scene.bottom.times(1 - k).plus(scene.top.times(k));
    }

    /** How a point light weakens with distance: ILL-7, and 1/d² of ILL-3. */
    private static double attenuation(Scene.Light light, double distance) {
        double divisor = light.constant() + light.linear() * distance + light.quadratic() * distance * distance;
        return light.isClamped() && divisor <= 1 ? 1 : 1 / divisor;
    }

    /** What one light adds where the ray hits and `reflected` starts. The normal is turned to the ray's origin. */
    private Scene.Vec litBy(Scene.Light light, Ray ray, Ray reflected, Scene.Vec normal) {
        Scene.Vec point = reflected.origin;
        Scene.Material material = reflected.leaves.material();
        boolean isDirectional = light.direction() != null;
        Scene.Vec way = isDirectional ? light.direction().times(-1) : light.position().minus(point);
        double distance = isDirectional ? FAR : way.length();
        if (distance == 0) return Scene.Vec.BLACK; // ILL-9
        Scene.Vec toLight = isDirectional ? way : way.times(1 / distance);
        double cosine = normal.dot(toLight);
        if (cosine <= 0 || isHidden(new Ray(point, toLight, reflected.leaves, ""), distance)) return Scene.Vec.BLACK; // ILL-2
        Scene.Vec weight = Scene.Vec.BLACK;
        if (material.diffuse() != null) // ILL-2, ILL-3
            weight = material.diffuse().at(point).times(scene.isRadiometric ? cosine / Math.PI : cosine);
        if (material.specular() != null) {
            double highlight = material.specular().isBlinn()
                ? normal.dot(toLight.minus(ray.direction).unit()) // ILL-6
                : reflected.direction.dot(toLight); // ILL-5
            double power = Math.pow(Math.max(highlight, 0), material.specular().exponent());
            weight = weight.plus(material.specular().reflectance().times(power));
        }
        return weight.times(light.intensity()).times(isDirectional ? 1 : attenuation(light, distance));
    }

    /** The light that comes back along a ray which has `depth` reflections and refractions left. TREE. */
    private Scene.Vec radiance(Ray ray, Scene.Material medium, int depth) {
        Hit hit = firstHit(ray, FAR);
        if (hit.primitive == null) {
            Scene.Vec seen = background(ray.direction); // BG-3: not absorbed
            return noted(ray, hit, null, seen, seen);
        }
        Scene.Vec point = ray.origin.plus(ray.direction.times(hit.distance));
        Scene.Vec normal = hit.primitive.normalAt(point);
        boolean enters = ray.direction.dot(normal) < 0; // ILL-1
        if (!enters) normal = normal.times(-1);
        Scene.Vec mirrorDirection = ray.direction.minus(normal.times(2 * ray.direction.dot(normal))); // REFL-1
        Ray reflected = new Ray(point, mirrorDirection, hit.primitive, ray.path);

        Scene.Material material = hit.primitive.material();
        Scene.Vec sum = Scene.Vec.BLACK;
        if (material.emission() != null) sum = sum.plus(material.emission().at(point));
        if (material.ambient() != null) sum = sum.plus(material.ambient().times(scene.ambientLight));
        if (material.diffuse() != null || material.specular() != null)
            for (Scene.Light light : scene.lights) sum = sum.plus(litBy(light, ray, reflected, normal));
        Scene.Vec local = sum;
        if (depth > 0 && material.mirror() != null) // REFL-2
            sum = sum.plus(material.mirror().times(radiance(reflected.by('M'), medium, depth - 1)));
        if (depth > 0 && material.dielectric() != null)
            sum = sum.plus(through(ray, reflected, normal, enters, medium, depth));

        if (medium != null && medium.dielectric().absorption() != null) {
            Scene.Vec sigma = medium.dielectric().absorption().times(-hit.distance); // REFR-7
            sum = sum.times(new Scene.Vec(Math.exp(sigma.x()), Math.exp(sigma.y()), Math.exp(sigma.z())));
        }
        return noted(ray, hit, normal, local, sum);
    }

    /** What a dielectric reflects and refracts. The normal is turned to the ray's origin. REFR. */
    private Scene.Vec through(Ray ray, Ray reflected, Scene.Vec normal, boolean enters, Scene.Material medium, int depth) {
        Scene.Material material = reflected.leaves.material();
        Scene.Dielectric glass = material.dielectric();
        Scene.Material outside = scene.outsideOf(glass);
        double outer = outside == null ? 1 : outside.dielectric().index();
        double eta = enters ? glass.index() / outer : outer / glass.index(); // REFR-1
        double c = -ray.direction.dot(normal);
        double gSquared = eta * eta - 1 + c * c; // REFR-2
        Scene.Vec mirrored = radiance(reflected.by('R'), medium, depth - 1);
        if (gSquared < 0) return glass.reflectance() == null ? mirrored : mirrored.times(glass.reflectance()); // REFR-5, 6
        double g = Math.sqrt(gSquared);
        double rS = (c - g) / (c + g), rP = (eta * eta * c - g) / (eta * eta * c + g);
        double fresnel = c > 0 ? (rS * rS + rP * rP) / 2 : 1; // REFR-4
        double transmitted = scene.isRadiometric ? (1 - fresnel) / (eta * eta) : 1 - fresnel;
        Scene.Vec direction = ray.direction.plus(normal.times(c - g)).times(1 / eta); // REFR-3
        Ray refracted = new Ray(reflected.origin, direction, reflected.leaves, ray.path + "T");
        Scene.Vec behind = radiance(refracted, enters ? material : outside, depth - 1); // REFR-9
        if (glass.reflectance() != null) // REFR-6
            return mirrored.times(glass.reflectance()).plus(behind.times(glass.transmittance()));
        return mirrored.times(fresnel).plus(behind.times(transmitted));
    }

    /** The ray through the centre of a pixel. CAM-3, CAM-4, IMG-1. */
    private Ray cameraRay(int column, int row) {
        Scene.Camera camera = scene.camera;
        double x = (column + 0.5 - camera.width() / 2.0) * camera.pixel();
        double y = (row + 0.5 - camera.height() / 2.0) * camera.pixel();
        Scene.Vec across = camera.right().times(x).plus(camera.down().times(y));
        if (camera.isPerspective()) return new Ray(camera.position(), camera.forward().plus(across).unit(), null, "");
        return new Ray(camera.position().plus(across), camera.forward(), null, "");
    }

    public static void main(String[] arguments) throws IOException {
        boolean isTraced = arguments.length == 5 && arguments[2].equals("--trace");
        if (arguments.length != 2 && !isTraced) {
            System.err.println("usage: java Tracer SCENE.json OUTPUT.pfm [--trace COLUMN ROW]");
            System.exit(2);
        }
        Scene scene = new Scene(Path.of(arguments[0]));
        Tracer tracer = new Tracer(scene, isTraced);
        if (isTraced) {
            Ray ray = tracer.cameraRay(Integer.parseInt(arguments[3]), Integer.parseInt(arguments[4]));
            tracer.radiance(ray, scene.camera.inside(), scene.maxDepth);
            return;
        }
        int width = scene.camera.width(), height = scene.camera.height();
        byte[] header = ("PF\n" + width + " " + height + "\n-1.0\n").getBytes(StandardCharsets.US_ASCII);
        ByteBuffer file = ByteBuffer.allocate(header.length + 12 * width * height).order(ByteOrder.LITTLE_ENDIAN);
        file.put(header); // the minus says little endian
        for (int row = height - 1; row >= 0; row--) // a PFM begins with the bottom row
            for (int column = 0; column < width; column++) {
                Scene.Vec color = tracer.radiance(tracer.cameraRay(column, row), scene.camera.inside(), scene.maxDepth);
                file.putFloat((float) color.x()).putFloat((float) color.y()).putFloat((float) color.z());
            }
        Files.write(Path.of(arguments[1]), file.array());
    }
}
