"use strict";

// What is drawn over the pixels: their numbers, a grid, the mark of what fails, and that of the chosen pixel.

const LEAST_FOR_GRID = 12; // below, lines would cover more than a sixth of a pixel
const FAILING_MARK = [
  [255, 0, 255, 255],
  [0, 0, 0, 255],
];

function drawMask(viewer, context, view) {
  const { width, height } = viewer.cell;
  if (viewer.maskFor !== viewer.tolerance) {
    const pixels = new ImageData(width, height);
    for (const place of failingPlaces(viewer)) {
      pixels.data.set(FAILING_MARK[((place % width) + Math.floor(place / width)) % 2], 4 * place);
    }
    viewer.mask = element("canvas", { width, height });
    viewer.mask.getContext("2d").putImageData(pixels, 0, 0);
    viewer.maskFor = viewer.tolerance;
  }
  context.imageSmoothingEnabled = false;
  context.drawImage(viewer.mask, -view.x * view.scale, -view.y * view.scale, width * view.scale, height * view.scale);
}

function drawNumbers(viewer, context, layer, view, ratio) {
  const size = view.scale;
  if (size / ratio < LEAST_FOR_GRID) return;
  const { left, top, right, bottom } = visiblePart(viewer);
  const hasNumbers = size / ratio >= LEAST_FOR_NUMBERS;
  context.font = `${Math.min(size / 4.6, 13 * ratio)}px ui-monospace, monospace`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.lineJoin = "round";
  context.strokeStyle = "rgba(128, 128, 128, 0.5)";
  context.lineWidth = ratio;
  for (let y = top; y < bottom; y += 1) {
    for (let x = left; x < right; x += 1) {
      const [screenX, screenY] = [(x - view.x) * size, (y - view.y) * size];
      context.strokeRect(screenX, screenY, size, size);
      if (hasNumbers)
        drawLines(context, linesOf(layer, y * viewer.cell.width + x), screenX + size / 2, screenY + size / 2, size);
    }
  }
}

function linesOf(layer, place) {
  const channels = layer.isTone ? COLOURS : 1;
  return [...layer.values.subarray(channels * place, channels * (place + 1))].map(short);
}

function drawLines(context, lines, x, y, size) {
  context.save();
  context.fillStyle = "#fff";
  context.strokeStyle = "#000";
  context.lineWidth = size / 24;
  lines.forEach((line, i) => {
    const at = y + (i - (lines.length - 1) / 2) * (size / 3.6);
    context.strokeText(line, x, at, size * 0.96);
    context.fillText(line, x, at, size * 0.96);
  });
  context.restore();
}

function drawMarker(viewer, context, view, ratio) {
  const size = Math.max(view.scale, 5 * ratio);
  const x = (viewer.pixel.x + 0.5 - view.x) * view.scale - size / 2;
  const y = (viewer.pixel.y + 0.5 - view.y) * view.scale - size / 2;
  for (const [colour, grow] of [
    ["#fff", 3],
    ["#000", 1.5],
  ]) {
    context.strokeStyle = colour;
    context.lineWidth = 2 * ratio;
    context.strokeRect(x - grow * ratio, y - grow * ratio, size + 2 * grow * ratio, size + 2 * grow * ratio);
  }
}
