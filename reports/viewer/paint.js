"use strict";

// Layers drawn on a canvas without WebGL: each is coloured once as a picture of its own size, which is then drawn at
// any zoom.

function settingsKey(layer, settings) {
  const { exposure, gamma, falseColour, scaleKind, gain, channel } = settings;
  return [layer.id, exposure, gamma, falseColour, scaleKind, gain, channel].join(" ");
}

function asScalar(layer, place, factor) {
  if (!layer.isTone) return layer.values[place];
  const first = COLOURS * place;
  return factor * luminance(layer.values[first], layer.values[first + 1], layer.values[first + 2]);
}

// Red, green, blue and opacity of each pixel, row by row.
function colouredPixels(layer, settings, width) {
  const bytes = new Uint8ClampedArray(4 * layer.classes.length);
  const isTone = layer.isTone && !settings.falseColour;
  const factor = layer.isTone ? 2 ** settings.exposure : 1;
  const scale = scaleOf(layer.isTone ? { ...layer, largest: 1 } : layer, settings);
  const table = COLOURS_OF[scale.isDiverging ? "diverging" : "sequential"];
  for (let place = 0; place < layer.classes.length; place += 1) {
    const pattern = PATTERNS[layer.classes[place]];
    const to = 4 * place;
    bytes[to + 3] = 255;
    if (pattern) {
      const parity = ((place % width) + Math.floor(place / width)) % 2;
      bytes.set(pattern.colours[parity], to);
    } else if (isTone) {
      for (let c = 0; c < COLOURS; c += 1) {
        bytes[to + c] = 255 * encodedLight(factor * layer.values[COLOURS * place + c], settings.gamma);
      }
    } else {
      const index = Math.round(position(asScalar(layer, place, factor), scale) * (TABLE_LENGTH - 1));
      bytes.set(table.subarray(COLOURS * index, COLOURS * (index + 1)), to);
    }
  }
  return bytes;
}

function makeCanvasPainter(width, height) {
  const pictures = new Map();
  const KEPT = 12; // as many layers as are flipped through, for the settings of now

  function pictureOf(layer, settings) {
    const key = settingsKey(layer, settings);
    let picture = pictures.get(key);
    if (!picture) {
      picture = element("canvas", { width, height });
      const pixels = new ImageData(colouredPixels(layer, settings, width), width, height);
      picture.getContext("2d").putImageData(pixels, 0, 0);
      if (pictures.size >= KEPT) pictures.delete(pictures.keys().next().value);
      pictures.set(key, picture);
    }
    return picture;
  }

  // `view` is {x, y, scale}: which point is at the top left, and how many pixels of the screen one of the image is large.
  function draw(context, layer, settings, view) {
    context.imageSmoothingEnabled = false;
    const { x, y, scale } = view;
    context.drawImage(pictureOf(layer, settings), -x * scale, -y * scale, width * scale, height * scale);
  }
  return { name: "canvas", draw };
}
