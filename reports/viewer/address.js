"use strict";

// The address of a cell's page, which leads back to pixel, layer, mode and view.

// What an address says after its #: pixel, layer, mode and zoom; whatever is not there or makes no sense is left out.
function readAddress(viewer) {
  const wanted = new URLSearchParams(location.hash.slice(1));
  const numbers = (name) => (wanted.get(name) ?? "").split(",").map(Number);
  const [x, y] = numbers("pixel");
  if (wanted.has("pixel") && Number.isFinite(x) && Number.isFinite(y)) {
    viewer.isPinned = true;
    choosePixel(viewer, x, y);
  }
  const layer = wanted.get("layer");
  if (viewer.images.has(layer) || FIELDS.some(({ id }) => id === layer)) show(viewer, layer);
  if (MODES.includes(wanted.get("mode"))) viewer.mode = wanted.get("mode");
  const [left, top, scale] = numbers("view");
  if ([left, top, scale].every(Number.isFinite) && scale > 0 && wanted.has("view")) {
    viewer.view = { x: left, y: top, scale: Math.min(scale, LARGEST_ZOOM) };
    viewer.isFitted = false;
  }
}

function writeAddress(viewer) {
  const { x, y, scale } = viewer.view;
  const parts = { pixel: `${viewer.pixel.x},${viewer.pixel.y}`, layer: viewer.current, mode: viewer.mode };
  if (!viewer.isFitted) parts.view = [x, y, scale].map((number) => number.toFixed(2)).join(",");
  if (!viewer.isPinned) delete parts.pixel;
  history.replaceState(null, "", `#${new URLSearchParams(parts).toString().replaceAll("%2C", ",")}`);
}
