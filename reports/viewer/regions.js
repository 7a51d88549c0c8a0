"use strict";

// Failing pixels, also if the tolerance were another, and the regions that they form.

// The farthest channel in tolerances; less than 0 where it is not judged. What is not a number is infinitely far.
function worstDistance(viewer, place) {
  const { distance } = viewer.arrays;
  const first = COLOURS * place;
  const worst = Math.max(distance[first], distance[first + 1], distance[first + 2]);
  return Number.isNaN(worst) ? Infinity : worst;
}

// If the tolerance of each pixel were so many times as large.
function failingPlaces(viewer) {
  const places = [];
  for (let place = 0; place < viewer.cell.width * viewer.cell.height; place += 1) {
    if (worstDistance(viewer, place) > viewer.tolerance) places.push(place);
  }
  return places;
}

// Pixels that touch, at a corner too, are one region: {places, worst, place of the worst}; the worst region first.
function failingRegions(viewer) {
  const { width, height } = viewer.cell;
  const left = new Set(failingPlaces(viewer));
  const regions = [];
  for (const start of left) {
    left.delete(start);
    const region = { count: 0, worst: -1, place: start };
    const waiting = [start];
    while (waiting.length) {
      const place = waiting.pop();
      region.count += 1;
      const distance = worstDistance(viewer, place);
      if (distance > region.worst) Object.assign(region, { worst: distance, place });
      for (const neighbour of neighboursOf(place, width, height)) {
        if (left.delete(neighbour)) waiting.push(neighbour);
      }
    }
    regions.push(region);
  }
  return regions.sort((a, b) => (a.worst === b.worst ? b.count - a.count : b.worst - a.worst));
}

function neighboursOf(place, width, height) {
  const [column, row] = [place % width, Math.floor(place / width)];
  const found = [];
  for (let y = Math.max(row - 1, 0); y <= Math.min(row + 1, height - 1); y += 1) {
    for (let x = Math.max(column - 1, 0); x <= Math.min(column + 1, width - 1); x += 1) found.push(y * width + x);
  }
  return found;
}

const MOST_REGIONS = 50; // in the list: more is not read

function makeRegions(viewer) {
  const summary = element("p", { className: "small" });
  const list = element("ol", { className: "regions" });
  let regions = [];
  let shownFor = null;
  let at = -1;

  function go(index) {
    if (regions.length === 0) return;
    at = (index + regions.length) % regions.length;
    viewer.isPinned = true;
    const { place } = regions[at];
    choosePixel(viewer, place % viewer.cell.width, Math.floor(place / viewer.cell.width));
    bringIntoSight(viewer);
    for (const button of list.querySelectorAll("button")) button.removeAttribute("aria-current");
    list.children[at]?.firstChild.setAttribute("aria-current", "true");
  }
  function fill() {
    if (shownFor === viewer.tolerance) return;
    shownFor = viewer.tolerance;
    regions = failingRegions(viewer);
    at = -1;
    const pixels = regions.reduce((sum, region) => sum + region.count, 0);
    const counts = { pixels, regions: regions.length, tolerance: rough(viewer.tolerance) };
    summary.textContent =
      viewer.tolerance === 1
        ? say("{pixels} failing pixels in {regions} regions.", counts)
        : say(
            "{pixels} pixels in {regions} regions would fail if the tolerance were {tolerance} times as large.",
            counts,
          );
    list.replaceChildren(
      ...regions.slice(0, MOST_REGIONS).map((region, index) => {
        const [x, y] = [region.place % viewer.cell.width, Math.floor(region.place / viewer.cell.width)];
        const words = { count: region.count, x, y, worst: rough(region.worst) };
        const button = element(
          "button",
          { type: "button" },
          say("{count} pixels, worst ({x}, {y}): {worst} tolerances", words),
        );
        button.addEventListener("click", () => go(index));
        return element("li", {}, button);
      }),
    );
  }
  viewer.listeners.push(fill);
  const next = { name: "Next failing region", key: "n", run: () => go(at + 1) };
  const previous = { name: "Previous failing region", key: "p", run: () => go(at < 0 ? -1 : at - 1) };
  return {
    panel: element("section", {}, element("h3", {}, say("Failing pixels")), summary, list),
    commands: [next, previous],
  };
}
