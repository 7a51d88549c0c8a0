package main

import (
	"encoding/json"
	"fmt"
	"math"
	"os"
	"path/filepath"
	"strconv"
	"strings"
)

// Vec is a point, a direction, or a colour.
type Vec [3]float64

func (a Vec) plus(b Vec) Vec       { return Vec{a[0] + b[0], a[1] + b[1], a[2] + b[2]} }
func (a Vec) minus(b Vec) Vec      { return Vec{a[0] - b[0], a[1] - b[1], a[2] - b[2]} }
func (a Vec) times(k float64) Vec  { return Vec{k * a[0], k * a[1], k * a[2]} }
func (a Vec) filteredBy(b Vec) Vec { return Vec{a[0] * b[0], a[1] * b[1], a[2] * b[2]} } // channel by channel
func (a Vec) dot(b Vec) float64    { return a[0]*b[0] + a[1]*b[1] + a[2]*b[2] }
func (a Vec) length() float64      { return math.Sqrt(a.dot(a)) }
func (a Vec) unit() Vec            { return a.times(1 / a.length()) }
func (a Vec) cross(b Vec) Vec {
	return Vec{a[1]*b[2] - a[2]*b[1], a[2]*b[0] - a[0]*b[2], a[0]*b[1] - a[1]*b[0]}
}

// The scene file (docs/scene-format.md), as encoding/json reads it. What may be absent is a pointer.

// Texture is a colour or a checkerboard.
type Texture struct {
	Even, Odd Vec
	Size      float64
	Plane     string
	Offset    [2]float64
}

// UnmarshalJSON reads [r, g, b] or {"checkerboard": {…}}.
func (texture *Texture) UnmarshalJSON(text []byte) error {
	var color Vec
	if json.Unmarshal(text, &color) == nil {
		*texture = Texture{Even: color, Odd: color, Size: 1, Plane: "xz"}
		return nil
	}
	type plain Texture // without this method
	board := struct{ Checkerboard plain }{plain{Size: 1, Plane: "xz"}}
	err := json.Unmarshal(text, &board)
	*texture = Texture(board.Checkerboard)
	return err
}

// at is the colour at a point of a surface: TEX-1, TEX-2.
func (texture *Texture) at(point Vec) Vec {
	squares := 0.0
	for i, offset := range texture.Offset {
		squares += math.Floor((point[texture.Plane[i]-'x'] - offset) / texture.Size)
	}
	if math.Mod(squares, 2) == 0 {
		return texture.Even
	}
	return texture.Odd
}

// Falloff is a polynomial; "none" and "inverse_square" are two whose value is not clamped.
type Falloff struct {
	Constant, Linear, Quadratic float64
	isClamped                   bool
}

// UnmarshalJSON reads "none", "inverse_square" or {"constant": …}.
func (falloff *Falloff) UnmarshalJSON(text []byte) error {
	switch string(text) {
	case `"none"`:
		*falloff = Falloff{Constant: 1}
	case `"inverse_square"`:
		*falloff = Falloff{Quadratic: 1}
	default:
		type plain Falloff // without this method
		stated := plain{isClamped: true}
		err := json.Unmarshal(text, &stated)
		*falloff = Falloff(stated)
		return err
	}
	return nil
}

// Light is a point light, or a directional one, which has a direction in place of a position.
type Light struct {
	Position, Direction   *Vec
	Intensity, Irradiance Vec
	Falloff               Falloff
}

// Reflectance is the one key of the terms that have no other.
type Reflectance struct{ Reflectance Vec }

// Specular is a highlight.
type Specular struct {
	Reflectance Vec
	Exponent    float64
	Model       string
}

// Dielectric is a smooth transparent interface.
type Dielectric struct {
	Index                                  float64 `json:"index_of_refraction"`
	Absorption, Reflectance, Transmittance *Vec
	Outside                                *string
}

// Material holds the terms that a material states.
type Material struct {
	Ambient, Mirror *Reflectance
	Diffuse         *struct{ Reflectance Texture }
	Emission        *struct{ Radiance Texture }
	Specular        *Specular
	Dielectric      *Dielectric
}

// Camera holds what a camera states, and below it what follows from that.
type Camera struct {
	Projection    string
	Position      Vec
	LookAt        Vec `json:"look_at"`
	Up            Vec
	FieldOfView   float64 `json:"vertical_field_of_view"`
	ViewHeight    float64 `json:"view_height"`
	Width, Height int
	Inside        *string

	forward, right, down Vec
	pixel                float64
}

// Object is a sphere, a triangle, a mesh or a plane.
type Object struct {
	Shape, Material, File string
	Center, Point, Normal Vec
	Radius                float64
	Vertices              []Vec
	Faces                 [][]int
}

// Scene holds what a scene states, and below it what follows from that.
type Scene struct {
	Convention   string
	MaxDepth     int `json:"max_depth"`
	Camera       Camera
	Background   struct{ Color, Bottom, Top *Vec }
	AmbientLight Vec `json:"ambient_light"`
	Lights       []Light
	Materials    map[string]*Material
	Objects      []Object

	primitives []*Primitive
}

// Primitive is a shape with a material.
type Primitive struct {
	Shape
	material *Material
}

// Shape is a sphere, a triangle or a plane; how rays meet them is told in tracer.go.
type Shape interface {
	meet(ray *Ray, isOwn bool) float64 // the distance, or infinity
	normalAt(point Vec) Vec            // the shape's own
}

// Sphere is all points at one distance from its center.
type Sphere struct {
	center Vec
	radius float64
}

// Triangle is a corner, the way from it to the other two, and the shape's own normal.
type Triangle struct{ a, ab, ac, normal Vec }

// Plane is infinite.
type Plane struct{ point, normal Vec }

// named is the material of that name, nil for empty space.
func (scene *Scene) named(name *string) *Material {
	if name == nil {
		return nil
	}
	return scene.Materials[*name]
}

func load(path string) (*Scene, error) {
	text, err := os.ReadFile(path)
	if err != nil {
		return nil, err
	}
	scene := &Scene{Camera: Camera{Up: Vec{0, 1, 0}}}
	if err := json.Unmarshal(text, scene); err != nil { // leaves alone what is null
		return nil, err
	}
	background := &scene.Background
	if background.Color == nil {
		background.Color = &Vec{}
	}
	if background.Bottom == nil {
		background.Bottom, background.Top = background.Color, background.Color
	}
	scene.Camera.aim()
	return scene, scene.number(filepath.Dir(path))
}

func (camera *Camera) aim() {
	camera.forward = camera.LookAt.minus(camera.Position).unit() // CAM-1
	camera.right = camera.forward.cross(camera.Up).unit()
	camera.down = camera.forward.cross(camera.right)
	viewHeight := camera.ViewHeight // CAM-4
	if camera.Projection == "perspective" {
		viewHeight = 2 * math.Tan(camera.FieldOfView*math.Pi/360) // CAM-3, at the distance 1
	}
	camera.pixel = viewHeight / float64(camera.Height)
}

// number lists the primitives: TRAV-2, all spheres, then all triangles, then all planes.
func (scene *Scene) number(folder string) error {
	var spheres, triangles, planes []*Primitive
	for _, object := range scene.Objects {
		material := scene.Materials[object.Material]
		switch object.Shape {
		case "sphere":
			spheres = append(spheres, &Primitive{&Sphere{object.Center, object.Radius}, material})
		case "plane":
			planes = append(planes, &Primitive{&Plane{object.Point, object.Normal.unit()}, material}) // PLANE-4
		case "triangle":
			object.Faces = [][]int{{0, 1, 2}}
		}
		if object.File != "" {
			if err := object.readObj(filepath.Join(folder, object.File)); err != nil {
				return err
			}
		}
		for _, face := range object.Faces {
			a := object.Vertices[face[0]]
			for i := 2; i < len(face); i++ { // a face of more corners is a fan
				ab, ac := object.Vertices[face[i-1]].minus(a), object.Vertices[face[i]].minus(a)
				triangle := &Triangle{a, ab, ac, ab.cross(ac).unit()} // TRI-4
				triangles = append(triangles, &Primitive{triangle, material})
			}
		}
	}
	scene.primitives = append(append(spheres, triangles...), planes...)
	return nil
}

// readObj reads the corners and faces of an OBJ file, of the kind that raytruth writes beside very large scenes.
func (object *Object) readObj(path string) error {
	text, err := os.ReadFile(path)
	if err != nil {
		return err
	}
	for _, line := range strings.Split(string(text), "\n") {
		words := strings.Fields(line)
		if len(words) == 0 {
			continue
		}
		if words[0] == "v" {
			var vertex Vec
			if _, err := fmt.Sscan(strings.Join(words[1:4], " "), &vertex[0], &vertex[1], &vertex[2]); err != nil {
				return err
			}
			object.Vertices = append(object.Vertices, vertex)
		} else if words[0] == "f" {
			var face []int
			for _, word := range words[1:] { // 7, 7/1 or 7/1/3: counted from 1; or -1, backwards from the last vertex
				number, err := strconv.Atoi(strings.Split(word, "/")[0])
				if err != nil {
					return err
				}
				if number < 0 {
					number += len(object.Vertices) + 1
				}
				face = append(face, number-1)
			}
			object.Faces = append(object.Faces, face)
		}
	}
	return nil
}
