// A Whitted ray tracer, written to raytruth's docs/spec.md, whose clauses are named beside the lines they belong to.
//
//	tracer SCENE.json OUTPUT.pfm                      the picture
//	tracer SCENE.json OUTPUT.pfm --trace COLUMN ROW   the rays of one pixel, for `raytruth trace`
package main

import (
	"bytes"
	"encoding/binary"
	"encoding/json"
	"fmt"
	"math"
	"os"
	"strconv"
)

// Ray is a half-line in a unit direction, and the primitive on whose surface it starts, or nil.
type Ray struct {
	origin, direction Vec
	leaves            *Primitive
	path              string // which mirrors (M), reflections (R) and refractions (T) of glass it has come by
}

var isTraced = len(os.Args) == 6 && os.Args[3] == "--trace"

// note prints a ray and what came of it as a line of JSON, if the rays of a pixel are asked for.
func (ray *Ray) note(told map[string]any) {
	if !isTraced {
		return
	}
	told["path"], told["origin"], told["direction"] = ray.path, ray.origin, ray.direction
	line, err := json.Marshal(told)
	if err == nil {
		fmt.Println(string(line))
	}
}

var far = math.Inf(1)

// Textbook quadratic: t² + 2bt + c = 0.
func (sphere *Sphere) meet(ray *Ray, isOwn bool) float64 {
	fromCenter := ray.origin.minus(sphere.center)
	b := ray.direction.dot(fromCenter)
	if isOwn { // SPH-4
		if b < 0 {
			return -2 * b
		}
		return far
	}
	discriminant := b*b - (fromCenter.dot(fromCenter) - sphere.radius*sphere.radius)
	if discriminant < 0 { // SPH-2
		return far
	}
	root := math.Sqrt(discriminant)
	if -b-root > 0 { // SPH-1
		return -b - root
	}
	if -b+root > 0 {
		return -b + root
	}
	return far
}

// Möller and Trumbore 1997. TRI-1 to TRI-3.
func (triangle *Triangle) meet(ray *Ray, isOwn bool) float64 {
	p := ray.direction.cross(triangle.ac)
	determinant := triangle.ab.dot(p)
	if isOwn || determinant == 0 {
		return far
	}
	s := ray.origin.minus(triangle.a)
	u := s.dot(p) / determinant
	if u < 0 || u > 1 {
		return far
	}
	q := s.cross(triangle.ab)
	v := ray.direction.dot(q) / determinant
	if v < 0 || u+v > 1 {
		return far
	}
	if distance := triangle.ac.dot(q) / determinant; distance > 0 {
		return distance
	}
	return far
}

// PLANE-1 to PLANE-3.
func (plane *Plane) meet(ray *Ray, isOwn bool) float64 {
	along := ray.direction.dot(plane.normal)
	if isOwn || along == 0 {
		return far
	}
	if distance := plane.point.minus(ray.origin).dot(plane.normal) / along; distance > 0 {
		return distance
	}
	return far
}

func (sphere *Sphere) normalAt(point Vec) Vec {
	return point.minus(sphere.center).unit() // SPH-5
}
func (triangle *Triangle) normalAt(Vec) Vec { return triangle.normal }
func (plane *Plane) normalAt(Vec) Vec       { return plane.normal }

// firstHit is the nearest hit, nil where nothing is hit. TRAV-1, TRAV-3: of equals the first stays.
func (scene *Scene) firstHit(ray *Ray) (nearest float64, hit *Primitive) {
	nearest = far
	for _, primitive := range scene.primitives {
		if distance := primitive.meet(ray, primitive == ray.leaves); distance < nearest {
			nearest, hit = distance, primitive
		}
	}
	return nearest, hit
}

// isHidden tells whether anything lies between the ray's start and the light. SHAD-1 to SHAD-4.
func (scene *Scene) isHidden(toLight *Ray, lightDistance float64) bool {
	for _, primitive := range scene.primitives {
		if primitive.meet(toLight, primitive == toLight.leaves) < lightDistance {
			return true
		}
	}
	return false
}

// background is what a ray brings that meets nothing. BG-1.
func (scene *Scene) background(direction Vec) Vec {
	k := (direction[1] + 1) / 2
	return scene.Background.Bottom.times(1 - k).plus(scene.Background.Top.times(k))
}

// at is how a point light weakens with distance: ILL-7, and 1/d² of ILL-3.
func (falloff *Falloff) at(distance float64) float64 {
	divisor := falloff.Constant + falloff.Linear*distance + falloff.Quadratic*distance*distance
	if falloff.isClamped && divisor <= 1 {
		return 1
	}
	return 1 / divisor
}

// litBy is what one light adds where the ray hits and `reflected` starts. The normal is turned to the ray's origin.
func (scene *Scene) litBy(light *Light, ray, reflected *Ray, normal Vec) Vec {
	material := reflected.leaves.material
	var distance float64
	var toLight, intensity Vec
	if light.Direction != nil {
		distance, toLight, intensity = far, light.Direction.unit().times(-1), light.Irradiance
	} else {
		way := light.Position.minus(reflected.origin)
		distance = way.length()
		if distance == 0 { // ILL-9
			return Vec{}
		}
		toLight, intensity = way.times(1/distance), light.Intensity.times(light.Falloff.at(distance))
	}
	cosine := normal.dot(toLight)
	if cosine <= 0 || scene.isHidden(&Ray{reflected.origin, toLight, reflected.leaves, ""}, distance) { // ILL-2
		return Vec{}
	}
	var weight Vec
	if material.Diffuse != nil {
		weight = material.Diffuse.Reflectance.at(reflected.origin).times(cosine)
		if scene.Convention == "radiometric" { // ILL-3
			weight = weight.times(1 / math.Pi)
		}
	}
	if specular := material.Specular; specular != nil {
		highlight := reflected.direction.dot(toLight) // ILL-5
		if specular.Model == "blinn" {
			highlight = normal.dot(toLight.minus(ray.direction).unit()) // ILL-6
		}
		weight = weight.plus(specular.Reflectance.times(math.Pow(max(highlight, 0), specular.Exponent)))
	}
	return weight.filteredBy(intensity)
}

// radiance is the light that comes back along a ray which has `depth` reflections and refractions left. TREE.
func (scene *Scene) radiance(ray *Ray, medium *Material, depth int) Vec {
	distance, hit := scene.firstHit(ray)
	if hit == nil {
		seen := scene.background(ray.direction) // BG-3: not absorbed
		ray.note(map[string]any{"distance": nil, "local": seen, "color": seen})
		return seen
	}
	point := ray.origin.plus(ray.direction.times(distance))
	normal := hit.normalAt(point)
	enters := ray.direction.dot(normal) < 0 // ILL-1
	if !enters {
		normal = normal.times(-1)
	}
	mirrorDirection := ray.direction.minus(normal.times(2 * ray.direction.dot(normal))) // REFL-1
	reflected := &Ray{point, mirrorDirection, hit, ray.path + "M"}

	material := hit.material
	var sum Vec
	if material.Emission != nil {
		sum = sum.plus(material.Emission.Radiance.at(point))
	}
	if material.Ambient != nil {
		sum = sum.plus(material.Ambient.Reflectance.filteredBy(scene.AmbientLight))
	}
	if material.Diffuse != nil || material.Specular != nil {
		for i := range scene.Lights {
			sum = sum.plus(scene.litBy(&scene.Lights[i], ray, reflected, normal))
		}
	}
	local := sum
	if depth > 0 && material.Mirror != nil { // REFL-2
		sum = sum.plus(material.Mirror.Reflectance.filteredBy(scene.radiance(reflected, medium, depth-1)))
	}
	if depth > 0 && material.Dielectric != nil {
		sum = sum.plus(scene.through(ray, reflected, normal, enters, medium, depth))
	}
	if medium != nil && medium.Dielectric.Absorption != nil { // REFR-7
		for i, sigma := range medium.Dielectric.Absorption {
			sum[i] *= math.Exp(-sigma * distance)
		}
	}
	ray.note(map[string]any{"distance": distance, "normal": normal, "local": local, "color": sum})
	return sum
}

// through is what a dielectric reflects and refracts. The normal is turned to the ray's origin. REFR.
func (scene *Scene) through(ray, reflected *Ray, normal Vec, enters bool, medium *Material, depth int) Vec {
	material := reflected.leaves.material
	glass, outside, outer := material.Dielectric, scene.named(material.Dielectric.Outside), 1.0
	if outside != nil {
		outer = outside.Dielectric.Index
	}
	eta, beyond := outer/glass.Index, outside // REFR-1, REFR-9
	if enters {
		eta, beyond = glass.Index/outer, material
	}
	c := -ray.direction.dot(normal)
	gSquared := eta*eta - 1 + c*c // REFR-2
	reflected.path = ray.path + "R"
	mirrored := scene.radiance(reflected, medium, depth-1)
	if gSquared < 0 { // REFR-5, REFR-6
		if glass.Reflectance != nil {
			return mirrored.filteredBy(*glass.Reflectance)
		}
		return mirrored
	}
	g, fresnel, scale := math.Sqrt(gSquared), 1.0, 1.0
	if c > 0 { // REFR-4
		rS, rP := (c-g)/(c+g), (eta*eta*c-g)/(eta*eta*c+g)
		fresnel = (rS*rS + rP*rP) / 2
	}
	if scene.Convention == "radiometric" { // REFR-5
		scale = 1 / (eta * eta)
	}
	direction := ray.direction.plus(normal.times(c - g)).times(1 / eta) // REFR-3
	behind := scene.radiance(&Ray{reflected.origin, direction, reflected.leaves, ray.path + "T"}, beyond, depth-1)
	if glass.Reflectance != nil { // REFR-6
		return mirrored.filteredBy(*glass.Reflectance).plus(behind.filteredBy(*glass.Transmittance))
	}
	return mirrored.times(fresnel).plus(behind.times(scale * (1 - fresnel)))
}

// ray goes through the centre of a pixel. CAM-3, CAM-4, IMG-1.
func (camera *Camera) ray(column, row int) *Ray {
	x := (float64(column) + 0.5 - float64(camera.Width)/2) * camera.pixel
	y := (float64(row) + 0.5 - float64(camera.Height)/2) * camera.pixel
	across := camera.right.times(x).plus(camera.down.times(y))
	if camera.Projection == "perspective" {
		return &Ray{camera.Position, camera.forward.plus(across).unit(), nil, ""}
	}
	return &Ray{camera.Position.plus(across), camera.forward, nil, ""}
}

func render(sceneFile, output string) error {
	scene, err := load(sceneFile)
	if err != nil {
		return err
	}
	camera := &scene.Camera
	if isTraced {
		return trace(scene, os.Args[4], os.Args[5])
	}
	var file bytes.Buffer
	fmt.Fprintf(&file, "PF\n%d %d\n-1.0\n", camera.Width, camera.Height) // the minus says little endian
	for row := camera.Height - 1; row >= 0; row-- {                      // a PFM begins with the bottom row
		for column := 0; column < camera.Width; column++ {
			color := scene.radiance(camera.ray(column, row), scene.named(camera.Inside), scene.MaxDepth)
			values := [3]float32{float32(color[0]), float32(color[1]), float32(color[2])}
			if err := binary.Write(&file, binary.LittleEndian, values); err != nil {
				return err
			}
		}
	}
	return os.WriteFile(output, file.Bytes(), 0o644)
}

func trace(scene *Scene, column, row string) error {
	x, err := strconv.Atoi(column)
	if err != nil {
		return err
	}
	y, err := strconv.Atoi(row)
	if err != nil {
		return err
	}
	scene.radiance(scene.Camera.ray(x, y), scene.named(scene.Camera.Inside), scene.MaxDepth)
	return nil
}

func main() {
	if len(os.Args) != 3 && !isTraced {
		fmt.Fprintln(os.Stderr, "usage: tracer SCENE.json OUTPUT.pfm [--trace COLUMN ROW]")
		os.Exit(2)
	}
	if err := render(os.Args[1], os.Args[2]); err != nil {
		fmt.Fprintln(os.Stderr, err)
		os.Exit(1)
	}
}
