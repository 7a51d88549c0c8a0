"use strict";

// From numbers to colours. The same formulas are in the shader of webgl.js.

const SCALE_KINDS = ["linear", "logarithmic", "symmetric"];
// Powers of ten below the largest value: what is smaller than a float32's relative error of 6e-8 is noise.
const STOPS_OF_LOGARITHM = 6;

// What a pixel is, beside its number: these are drawn as patterns of two colours, pixel by pixel.
const ORDINARY = 0;
const NOT_A_NUMBER = 1;
const INFINITE = 2;
const MINUS_INFINITE = 3;
const NEGATIVE = 4;
const UNJUDGED = 5;
const PATTERNS = {
  [NOT_A_NUMBER]: {
    name: "not a number",
    colours: [
      [255, 0, 255],
      [0, 0, 0],
    ],
  },
  [INFINITE]: {
    name: "infinite",
    colours: [
      [255, 0, 255],
      [255, 255, 255],
    ],
  },
  [MINUS_INFINITE]: {
    name: "−infinite",
    colours: [
      [0, 0, 0],
      [255, 255, 255],
    ],
  },
  [NEGATIVE]: {
    name: "negative",
    colours: [
      [0, 140, 190],
      [0, 30, 60],
    ],
  },
  [UNJUDGED]: {
    name: "not judged",
    colours: [
      [140, 140, 140],
      [217, 217, 217],
    ],
  },
};

function bytesOf(table) {
  const bytes = new Uint8Array(table.length / 2);
  for (let i = 0; i < bytes.length; i += 1) bytes[i] = Number.parseInt(table.slice(2 * i, 2 * i + 2), 16);
  return bytes;
}
const COLOURS_OF = { sequential: bytesOf(COLOUR_TABLES.batlow), diverging: bytesOf(COLOUR_TABLES.vik) };
const TABLE_LENGTH = 256;

const symmetricLogarithm = (value, threshold) => Math.sign(value) * Math.log1p(Math.abs(value) / threshold);

// Where a number lies on its scale, from 0 to 1. A scale is {kind, isDiverging, largest, threshold}: of a diverging one
// 0 is in the middle; the symmetric logarithm is nearly linear up to the threshold.
function position(value, scale) {
  const { kind, isDiverging, largest, threshold } = scale;
  let part;
  if (kind === "symmetric") part = symmetricLogarithm(value, threshold) / symmetricLogarithm(largest, threshold);
  else if (kind === "logarithmic") part = 1 + Math.log10(Math.max(value, 1e-45) / largest) / STOPS_OF_LOGARITHM;
  else part = value / largest;
  return Math.min(Math.max(isDiverging ? (part + 1) / 2 : part, 0), 1);
}

// The number at a position: for the ends and the marks of the scale bar.
function valueAt(place, scale) {
  const { kind, isDiverging, largest, threshold } = scale;
  const part = isDiverging ? 2 * place - 1 : place;
  if (kind === "symmetric") {
    return Math.sign(part) * threshold * Math.expm1(Math.abs(part) * symmetricLogarithm(largest, threshold));
  }
  return kind === "logarithmic" ? largest * 10 ** ((part - 1) * STOPS_OF_LOGARITHM) : part * largest;
}

function scaleOf(layer, settings) {
  const isDiverging = layer.isDiverging;
  const wanted = settings.scaleKind === "automatic" ? layer.scaleKind : settings.scaleKind;
  const kind = wanted === "logarithmic" && isDiverging ? "symmetric" : wanted; // negative numbers have no logarithm
  const largest = (layer.largest || 1) * 2 ** -settings.gain;
  return { kind, isDiverging, largest, threshold: Math.min(layer.threshold ?? largest / 1000, largest) };
}

// sRGB's curve (IEC 61966-2-1), or a power; light from 0 to 1.
function encodedLight(light, gamma) {
  const clipped = Math.min(Math.max(light, 0), 1);
  if (gamma !== 0) return clipped ** (1 / gamma);
  return clipped <= 0.0031308 ? 12.92 * clipped : 1.055 * clipped ** (1 / 2.4) - 0.055;
}

// Luminance of linear Rec. 709 light (ITU-R BT.709-6, item 3.2).
const luminance = (red, green, blue) => 0.2126 * red + 0.7152 * green + 0.0722 * blue;
