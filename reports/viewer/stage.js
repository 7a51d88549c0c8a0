"use strict";

// The panes of a viewer: which layers they show, and the zoom and pan that all of them share.

const MODES = ["flip", "slider", "side by side"];
const LEAST_FOR_NUMBERS = 44; // pixels of the screen: four digits of the smallest legible type are so wide
const LARGEST_ZOOM = 160; // pixels of the screen: more than all digits of a pixel need

function makePane(viewer) {
  const canvas = element("canvas", { "aria-hidden": "true" });
  const label = element("span", { className: "pane-label" });
  const pane = { canvas, label, host: element("div", { className: "pane" }, canvas, label) };
  listenToPointer(viewer, pane);
  return pane;
}

// Which layers each pane shows: [left of the divider, right of it], or one.
function shownLayers(viewer) {
  const shown = viewer.held ?? viewer.current;
  if (viewer.mode === "flip") return [[shown]];
  if (viewer.mode === "slider") return [[viewer.previous, shown]];
  return [
    ...new Set([
      "truth",
      "render",
      shown === "truth" || shown === "render" ? (viewer.isJudged ? "tolerance" : "signed") : shown,
    ]),
  ].map((id) => [id]);
}

function layOut(viewer) {
  const wanted = shownLayers(viewer).length;
  while (viewer.panes.length < wanted) viewer.panes.push(makePane(viewer));
  viewer.panes.length = wanted;
  viewer.stage.dataset.panes = wanted;
  viewer.stage.replaceChildren(...viewer.panes.map((pane) => pane.host));
  const ratio = window.devicePixelRatio;
  for (const pane of viewer.panes) {
    pane.canvas.width = Math.max(1, Math.round(pane.host.clientWidth * ratio));
    pane.canvas.height = Math.max(1, Math.round(pane.host.clientHeight * ratio));
  }
}

function paneSize(viewer) {
  const { clientWidth, clientHeight } = viewer.panes[0].host;
  return [clientWidth || 1, clientHeight || 1];
}

function fit(viewer) {
  const [width, height] = paneSize(viewer);
  const { width: columns, height: rows } = viewer.cell;
  const scale = Math.min(width / columns, height / rows);
  viewer.view = { scale, x: (columns - width / scale) / 2, y: (rows - height / scale) / 2 };
  viewer.isFitted = true;
  refresh(viewer);
}

// About a point of the image, which keeps its place on the screen.
function zoomAbout(viewer, factor, x, y) {
  const old = viewer.view.scale;
  const [width, height] = paneSize(viewer);
  const least = Math.min(width / viewer.cell.width, height / viewer.cell.height, 1) / 2;
  const scale = Math.min(Math.max(old * factor, least), LARGEST_ZOOM);
  viewer.view = { scale, x: x - ((x - viewer.view.x) * old) / scale, y: y - ((y - viewer.view.y) * old) / scale };
  viewer.isFitted = false;
  refresh(viewer);
}

const zoomAtPixel = (viewer, factor) => zoomAbout(viewer, factor, viewer.pixel.x + 0.5, viewer.pixel.y + 0.5);

function centreOnPixel(viewer, scale = viewer.view.scale) {
  const [width, height] = paneSize(viewer);
  const { x, y } = viewer.pixel;
  viewer.view = { scale, x: x + 0.5 - width / scale / 2, y: y + 0.5 - height / scale / 2 };
  viewer.isFitted = false;
  refresh(viewer);
}

// By parts of what is seen.
function pan(viewer, right, down) {
  const [width, height] = paneSize(viewer);
  viewer.view.x += (right * width) / viewer.view.scale;
  viewer.view.y += (down * height) / viewer.view.scale;
  viewer.isFitted = false;
  refresh(viewer);
}

// Moves what is seen only where the pixel would be out of sight.
function bringIntoSight(viewer) {
  const [width, height] = paneSize(viewer);
  const { x, y, scale } = viewer.view;
  const isSeen = (at, from, size) => at >= from && at + 1 <= from + size / scale;
  if (!isSeen(viewer.pixel.x, x, width) || !isSeen(viewer.pixel.y, y, height)) centreOnPixel(viewer);
}

function show(viewer, id) {
  if (id === viewer.current) return;
  viewer.previous = viewer.current;
  viewer.current = id;
  refresh(viewer);
}

// Everything that is shown follows from the viewer's state, once a frame.
function refresh(viewer) {
  if (viewer.isWaiting) return;
  viewer.isWaiting = true;
  requestAnimationFrame(() => {
    viewer.isWaiting = false;
    draw(viewer);
    for (const listener of viewer.listeners) listener();
  });
}

function draw(viewer) {
  const layers = shownLayers(viewer);
  if (layers.length !== viewer.panes.length) {
    layOut(viewer);
    if (viewer.isFitted) fit(viewer);
  }
  viewer.panes.forEach((pane, i) =>
    drawPane(
      viewer,
      pane,
      layers[i].map((id) => layerOf(viewer, id)),
    ),
  );
}

function drawPane(viewer, pane, layers) {
  const context = pane.canvas.getContext("2d");
  const ratio = window.devicePixelRatio;
  const { width, height } = pane.canvas;
  const view = { ...viewer.view, scale: viewer.view.scale * ratio };
  context.clearRect(0, 0, width, height);
  const divider = layers.length > 1 ? Math.round(width * viewer.divider) : 0;
  layers.forEach((layer, i) => {
    const isLeft = layers.length > 1 && i === 0;
    const [from, to] = isLeft ? [0, divider] : [divider, width];
    context.save();
    context.beginPath();
    context.rect(from, 0, to - from, height);
    context.clip();
    viewer.painter.draw(context, layer, viewer.settings, view);
    drawNumbers(viewer, context, layer, view, ratio);
    context.restore();
  });
  if (viewer.isMasked) drawMask(viewer, context, view);
  if (divider) {
    context.fillStyle = "#fff";
    context.fillRect(divider - ratio, 0, 2 * ratio, height);
  }
  drawMarker(viewer, context, view, ratio);
  pane.label.textContent = layers.map((layer) => layerName(layer)).join(" | ");
}

function visiblePart(viewer) {
  const [width, height] = paneSize(viewer);
  const { x, y, scale } = viewer.view;
  const within = (value, size) => Math.min(Math.max(value, 0), size);
  return {
    left: within(Math.floor(x), viewer.cell.width),
    top: within(Math.floor(y), viewer.cell.height),
    right: within(Math.ceil(x + width / scale), viewer.cell.width),
    bottom: within(Math.ceil(y + height / scale), viewer.cell.height),
  };
}
