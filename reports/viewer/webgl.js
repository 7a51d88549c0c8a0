"use strict";

// Layers drawn by WebGL 2: the numbers themselves are textures, which the shader colours as scales.js does. One context
// draws for all panes, since browsers allow few of them.

const VERTEX_SHADER = `#version 300 es
in vec2 corner;
void main() { gl_Position = vec4(corner, 0.0, 1.0); }`;

const FRAGMENT_SHADER = `#version 300 es
precision highp float;
precision highp sampler2D;
uniform sampler2D numbers;   // red, green, blue and the class of a pixel
uniform sampler2D table;
uniform vec2 origin;         // which point of the image is at the top left
uniform float zoom;          // how many pixels of the screen one is large
uniform float screenHeight;
uniform ivec2 size;
uniform bool isTone;
uniform bool isImage;
uniform float factor;
uniform float gamma;         // 0: sRGB's curve
uniform int kind;            // 0 linear, 1 logarithmic, 2 symmetric
uniform bool isDiverging;
uniform float largest;
uniform float threshold;
uniform vec3 patterns[12];
out vec4 colour;

float symmetric(float value) { return sign(value) * log(1.0 + abs(value) / threshold); }

float position(float value) {
  float part = value / largest;
  if (kind == 2) part = symmetric(value) / symmetric(largest);
  if (kind == 1) part = 1.0 + log(max(value / largest, 1e-30)) / (log(10.0) * ${STOPS_OF_LOGARITHM}.0);
  return clamp(isDiverging ? (part + 1.0) / 2.0 : part, 0.0, 1.0);
}

vec3 encoded(vec3 light) {
  vec3 clipped = clamp(light, 0.0, 1.0);
  if (gamma != 0.0) return pow(clipped, vec3(1.0 / gamma));
  return mix(1.055 * pow(clipped, vec3(1.0 / 2.4)) - 0.055, 12.92 * clipped, lessThanEqual(clipped, vec3(0.0031308)));
}

void main() {
  vec2 place = origin + vec2(gl_FragCoord.x, screenHeight - gl_FragCoord.y) / zoom;
  ivec2 pixel = ivec2(floor(place));
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, size))) { colour = vec4(0.0); return; }
  vec4 found = texelFetch(numbers, pixel, 0);
  int pattern = int(found.a + 0.5);
  if (pattern != 0) { colour = vec4(patterns[2 * pattern + (pixel.x + pixel.y) % 2], 1.0); return; }
  if (isTone) { colour = vec4(encoded(factor * found.rgb), 1.0); return; }
  float value = isImage ? factor * dot(found.rgb, vec3(0.2126, 0.7152, 0.0722)) : found.r;
  int index = int(floor(position(value) * ${TABLE_LENGTH - 1}.0 + 0.5));
  colour = vec4(texelFetch(table, ivec2(index, 0), 0).rgb, 1.0);
}`;

function compiledProgram(gl) {
  const program = gl.createProgram();
  for (const [kind, source] of [
    [gl.VERTEX_SHADER, VERTEX_SHADER],
    [gl.FRAGMENT_SHADER, FRAGMENT_SHADER],
  ]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  return gl.getProgramParameter(program, gl.LINK_STATUS) ? program : null;
}

function nearestTexture(gl, format, width, height, layout, type, data) {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.NEAREST);
  gl.texImage2D(gl.TEXTURE_2D, 0, format, width, height, 0, layout, type, data);
  return texture;
}

// The values with the classes beside them; what is no ordinary number is 0, since shaders may not know such numbers.
function withClasses(layer) {
  const packed = new Float32Array(4 * layer.classes.length);
  const channels = layer.isTone ? COLOURS : 1;
  for (let place = 0; place < layer.classes.length; place += 1) {
    packed[4 * place + 3] = layer.classes[place];
    if (layer.classes[place] !== ORDINARY) continue;
    for (let c = 0; c < channels; c += 1) packed[4 * place + c] = layer.values[channels * place + c];
  }
  return packed;
}

function patternColours() {
  const colours = new Float32Array(36);
  for (const [kind, { colours: pair }] of Object.entries(PATTERNS)) {
    pair.forEach((rgb, i) =>
      colours.set(
        rgb.map((byte) => byte / 255),
        6 * Number(kind) + 3 * i,
      ),
    );
  }
  return colours;
}

// The names of those that browsers on common systems come with. The option failIfMajorPerformanceCaveat does not tell.
function isSoftware(gl) {
  const known = gl.getExtension("WEBGL_debug_renderer_info");
  const name = gl.getParameter(known ? known.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  return /SwiftShader|llvmpipe|Basic Render/i.test(name);
}

// null where there is no WebGL 2, or the image is larger than its textures. Software that stands in for a graphics
// processor is slower than a canvas, and taken only if it is asked for.
function makeWebglPainter(width, height, isAsked) {
  const canvas = element("canvas");
  const gl = canvas.getContext("webgl2", { alpha: true, premultipliedAlpha: false, antialias: false });
  if (!gl || (isSoftware(gl) && !isAsked) || Math.max(width, height) > gl.getParameter(gl.MAX_TEXTURE_SIZE))
    return null;
  const program = compiledProgram(gl);
  if (!program) return null;
  gl.useProgram(program);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 3, -1, -1, 3]), gl.STATIC_DRAW); // a triangle over all
  const corner = gl.getAttribLocation(program, "corner");
  gl.enableVertexAttribArray(corner);
  gl.vertexAttribPointer(corner, 2, gl.FLOAT, false, 0, 0);
  const place = (name) => gl.getUniformLocation(program, name);
  gl.uniform3fv(place("patterns"), patternColours());
  gl.uniform2i(place("size"), width, height);
  gl.uniform1i(place("table"), 1);
  const textures = new Map();
  const tables = {};
  gl.activeTexture(gl.TEXTURE1);
  for (const [name, bytes] of Object.entries(COLOURS_OF)) {
    tables[name] = nearestTexture(gl, gl.RGB8, TABLE_LENGTH, 1, gl.RGB, gl.UNSIGNED_BYTE, bytes);
  }

  function textureOf(layer) {
    gl.activeTexture(gl.TEXTURE0);
    if (!textures.has(layer)) {
      textures.set(layer, nearestTexture(gl, gl.RGBA32F, width, height, gl.RGBA, gl.FLOAT, withClasses(layer)));
    }
    return textures.get(layer);
  }

  function colourBy(layer, settings) {
    const scale = scaleOf(layer.isTone ? { ...layer, largest: 1 } : layer, settings);
    gl.bindTexture(gl.TEXTURE_2D, textureOf(layer));
    gl.activeTexture(gl.TEXTURE1);
    gl.bindTexture(gl.TEXTURE_2D, tables[scale.isDiverging ? "diverging" : "sequential"]);
    gl.uniform1i(place("isTone"), Number(layer.isTone && !settings.falseColour));
    gl.uniform1i(place("isImage"), Number(layer.isTone));
    gl.uniform1i(place("isDiverging"), Number(scale.isDiverging));
    gl.uniform1i(place("kind"), SCALE_KINDS.indexOf(scale.kind));
    gl.uniform1f(place("factor"), layer.isTone ? 2 ** settings.exposure : 1);
    gl.uniform1f(place("gamma"), settings.gamma);
    gl.uniform1f(place("largest"), scale.largest);
    gl.uniform1f(place("threshold"), scale.threshold);
  }

  function draw(context, layer, settings, view) {
    const target = context.canvas;
    if (canvas.width < target.width || canvas.height < target.height) {
      canvas.width = Math.max(canvas.width, target.width);
      canvas.height = Math.max(canvas.height, target.height);
    }
    gl.viewport(0, 0, canvas.width, canvas.height);
    colourBy(layer, settings);
    gl.uniform2f(place("origin"), view.x, view.y);
    gl.uniform1f(place("zoom"), view.scale);
    gl.uniform1f(place("screenHeight"), canvas.height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    context.drawImage(canvas, 0, 0, target.width, target.height, 0, 0, target.width, target.height);
  }
  return { name: "WebGL", draw };
}

// `?painter=canvas` or `?painter=webgl` in the address chooses, to compare the two.
function makePainter(width, height) {
  const asked = new URLSearchParams(location.search).get("painter");
  const webgl = asked === "canvas" ? null : makeWebglPainter(width, height, asked === "webgl");
  return webgl ?? makeCanvasPainter(width, height);
}
