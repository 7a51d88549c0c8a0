import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

/** What a scene is, and how it is read from its file (docs/scene-format.md). What is not stated is null. */
final class Scene {
    /** A point, a direction, or a colour. */
    record Vec(double x, double y, double z) {
        static final Vec BLACK = new Vec(0, 0, 0);

        Vec plus(Vec b) { return new Vec(x + b.x, y + b.y, z + b.z); }
        Vec minus(Vec b) { return new Vec(x - b.x, y - b.y, z - b.z); }
        Vec times(Vec b) { return new Vec(x * b.x, y * b.y, z * b.z); } // channel by channel
        Vec times(double k) { return new Vec(k * x, k * y, k * z); }
        double dot(Vec b) { return x * b.x + y * b.y + z * b.z; }
        Vec cross(Vec b) { return new Vec(y * b.z - z * b.y, z * b.x - x * b.z, x * b.y - y * b.x); }
        double length() { return Math.sqrt(dot(this)); }
        Vec unit() { return times(1 / length()); }
        double on(int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
    }

    /** The colour at each point of a surface. */
    interface Texture {
        Vec at(Vec point);
    }

    record Checkerboard(Vec even, Vec odd, double size, int u, int v, double offsetU, double offsetV) implements Texture {
        public Vec at(Vec point) { // TEX-1, TEX-2
            double squares = Math.floor((point.on(u) - offsetU) / size) + Math.floor((point.on(v) - offsetV) / size);
            return squares % 2 == 0 ? even : odd;
        }
    }

    record Specular(Vec reflectance, double exponent, boolean isBlinn) {}

    record Dielectric(double index, Vec absorption, Vec reflectance, Vec transmittance, String outside) {}

    record Material(Vec ambient, Texture diffuse, Specular specular, Vec mirror, Texture emission, Dielectric dielectric) {}

    interface Primitive {
        Material material();
        Vec normalAt(Vec point); // the shape's own
    }

    record Sphere(Vec center, double radius, Material material) implements Primitive {
        public Vec normalAt(Vec point) { return point.minus(center).unit(); } // SPH-5
    }

    /** A corner, the way from it to the other two, and the shape's own normal. */
    record Triangle(Vec a, Vec ab, Vec ac, Vec normal, Material material) implements Primitive {
        public Vec normalAt(Vec point) { return normal; }
    }

    record Plane(Vec point, Vec normal, Material material) implements Primitive {
        public Vec normalAt(Vec point) { return normal; }
    }

    /** A point light, or a directional one, which has a direction in place of a position. */
    record Light(Vec position, Vec direction, Vec intensity, double constant, double linear, double quadratic, boolean isClamped) {}

    record Camera(Vec position, Vec forward, Vec right, Vec down, boolean isPerspective, double pixel, int width, int height, Material inside) {}

    final boolean isRadiometric;
    final int maxDepth;
    final Camera camera;
    final Vec bottom, top, ambientLight;
    final List<Light> lights = new ArrayList<>();
    final Map<String, Material> materials = new HashMap<>();
    final List<Sphere> spheres = new ArrayList<>();
    final List<Triangle> triangles = new ArrayList<>();
    final List<Plane> planes = new ArrayList<>();

    Scene(Path path) throws IOException {
        Map<?, ?> stated = (Map<?, ?>) Json.read(Files.readString(path));
        isRadiometric = stated.get("convention").equals("radiometric");
        maxDepth = (int) number(stated, "max_depth", 0);
        Map<?, ?> background = stated.get("background") == null ? Map.of() : (Map<?, ?>) stated.get("background");
        bottom = vec(background, background.containsKey("color") ? "color" : "bottom", Vec.BLACK);
        top = vec(background, background.containsKey("color") ? "color" : "top", Vec.BLACK);
        ambientLight = vec(stated, "ambient_light", Vec.BLACK);
        for (Map.Entry<?, ?> entry : ((Map<?, ?>) stated.get("materials")).entrySet())
            materials.put((String) entry.getKey(), material((Map<?, ?>) entry.getValue()));
        camera = camera((Map<?, ?>) stated.get("camera"));
        if (stated.get("lights") != null)
            for (Object light : (List<?>) stated.get("lights")) lights.add(light((Map<?, ?>) light));
        for (Object object : (List<?>) stated.get("objects")) addObject((Map<?, ?>) object, path);
    }

    /** The material outside of a dielectric; null for empty space. */
    Material outsideOf(Dielectric glass) {
        return glass.outside == null ? null : materials.get(glass.outside);
    }

    private static Vec vec(Object stated) {
        List<?> list = (List<?>) stated;
        return new Vec((Double) list.get(0), (Double) list.get(1), (Double) list.get(2));
    }

    private static Vec vec(Map<?, ?> stated, String key, Vec otherwise) {
        return stated.get(key) == null ? otherwise : vec(stated.get(key));
    }

    private static double number(Map<?, ?> stated, String key, double otherwise) {
        return stated.get(key) == null ? otherwise : (Double) stated.get(key);
    }

    private static Texture texture(Object stated) {
        if (stated instanceof List<?> list) {
            Vec color = vec(list);
            return point -> color;
        }
        Map<?, ?> board = (Map<?, ?>) ((Map<?, ?>) stated).get("checkerboard");
        String plane = board.get("plane") == null ? "xz" : (String) board.get("plane");
        List<?> offset = board.get("offset") == null ? List.of(0.0, 0.0) : (List<?>) board.get("offset");
        return new Checkerboard(vec(board.get("even")), vec(board.get("odd")), number(board, "size", 1),
            plane.charAt(0) - 'x', plane.charAt(1) - 'x', (Double) offset.get(0), (Double) offset.get(1));
    }

    private static Material material(Map<?, ?> stated) {
        Map<?, ?> ambient = (Map<?, ?>) stated.get("ambient"), diffuse = (Map<?, ?>) stated.get("diffuse");
        Map<?, ?> specular = (Map<?, ?>) stated.get("specular"), mirror = (Map<?, ?>) stated.get("mirror");
        Map<?, ?> emission = (Map<?, ?>) stated.get("emission"), glass = (Map<?, ?>) stated.get("dielectric");
        return new Material(
            ambient == null ? null : vec(ambient.get("reflectance")),
            diffuse == null ? null : texture(diffuse.get("reflectance")),
            specular == null ? null : new Specular(vec(specular.get("reflectance")), (Double) specular.get("exponent"),
                specular.get("model").equals("blinn")),
            mirror == null ? null : vec(mirror.get("reflectance")),
            emission == null ? null : texture(emission.get("radiance")),
            glass == null ? null : new Dielectric((Double) glass.get("index_of_refraction"), vec(glass, "absorption", null),
                vec(glass, "reflectance", null), vec(glass, "transmittance", null), (String) glass.get("outside")));
    }

    private static Light light(Map<?, ?> stated) {
        if (stated.get("kind").equals("directional"))
            return new Light(null, vec(stated.get("direction")).unit(), vec(stated.get("irradiance")), 1, 0, 0, false);
        Vec position = vec(stated.get("position")), intensity = vec(stated.get("intensity"));
        if (stated.get("falloff") instanceof Map<?, ?> falloff)
            return new Light(position, null, intensity, (Double) falloff.get("constant"), (Double) falloff.get("linear"),
                (Double) falloff.get("quadratic"), true);
        boolean isConstant = stated.get("falloff").equals("none");
        return new Light(position, null, intensity, isConstant ? 1 : 0, 0, isConstant ? 0 : 1, false);
    }

    private Camera camera(Map<?, ?> stated) {
        Vec position = vec(stated.get("position"));
        Vec forward = vec(stated.get("look_at")).minus(position).unit(); // CAM-1
        Vec right = forward.cross(vec(stated, "up", new Vec(0, 1, 0))).unit();
        boolean isPerspective = stated.get("projection").equals("perspective");
        int width = (int) number(stated, "width", 0), height = (int) number(stated, "height", 0);
        // The height of the image plane: CAM-3 at the distance 1, CAM-4.
        double viewHeight = isPerspective
            ? 2 * Math.tan((Double) stated.get("vertical_field_of_view") * Math.PI / 360)
            : (Double) stated.get("view_height");
        Material inside = stated.get("inside") == null ? null : materials.get(stated.get("inside"));
        return new Camera(position, forward, right, forward.cross(right), isPerspective, viewHeight / height, width, height, inside);
    }

    private void addObject(Map<?, ?> stated, Path sceneFile) throws IOException {
        Material material = materials.get(stated.get("material"));
        if (stated.get("shape").equals("sphere")) {
            spheres.add(new Sphere(vec(stated.get("center")), (Double) stated.get("radius"), material));
            return;
        }
        if (stated.get("shape").equals("plane")) {
            planes.add(new Plane(vec(stated.get("point")), vec(stated.get("normal")).unit(), material)); // PLANE-4
            return;
        }
        List<Vec> vertices = new ArrayList<>();
        List<int[]> faces = new ArrayList<>();
        if (stated.get("file") != null) {
            readObj(sceneFile.resolveSibling((String) stated.get("file")), vertices, faces);
        } else {
            for (Object vertex : (List<?>) stated.get("vertices")) vertices.add(vec(vertex));
            if (stated.get("shape").equals("triangle")) faces.add(new int[] {0, 1, 2});
            else for (Object face : (List<?>) stated.get("faces"))
                faces.add(((List<?>) face).stream().mapToInt(number -> ((Double) number).intValue()).toArray());
        }
        for (int[] face : faces)
            for (int i = 2; i < face.length; i++) { // a face of more corners is a fan
                Vec a = vertices.get(face[0]);
                Vec ab = vertices.get(face[i - 1]).minus(a), ac = vertices.get(face[i]).minus(a);
                triangles.add(new Triangle(a, ab, ac, ab.cross(ac).unit(), material)); // TRI-4
            }
    }

    /** The corners and faces of an OBJ file, of the kind that raytruth writes beside very large scenes. */
    private static void readObj(Path path, List<Vec> vertices, List<int[]> faces) throws IOException {
        for (String line : Files.readAllLines(path)) {
            String[] words = line.strip().split("\\s+");
            if (words[0].equals("v")) {
                vertices.add(new Vec(Double.parseDouble(words[1]), Double.parseDouble(words[2]), Double.parseDouble(words[3])));
            } else if (words[0].equals("f")) {
                int[] face = new int[words.length - 1];
                for (int i = 0; i < face.length; i++) { // 7, 7/1 or 7/1/3: counted from 1; or -1, backwards from the last vertex
                    int number = Integer.parseInt(words[i + 1].split("/")[0]);
                    face[i] = number > 0 ? number - 1 : number + vertices.size();
                }
                faces.add(face);
            }
        }
    }
}
