"use strict";

// Statistics of the layer that is shown, over the part of it that is seen: zoom in for those of a crop.

function channelStatistics(layer, channel, part, width) {
  const channels = layer.isTone ? COLOURS : 1;
  const found = { least: Infinity, largest: -Infinity, sum: 0, squares: 0, count: 0, strange: 0 };
  for (let y = part.top; y < part.bottom; y += 1) {
    for (let x = part.left; x < part.right; x += 1) {
      const place = y * width + x;
      const value = layer.values[channels * place + channel];
      if (layer.classes[place] === UNJUDGED) continue;
      if (!Number.isFinite(value)) {
        found.strange += 1;
        continue;
      }
      found.least = Math.min(found.least, value);
      found.largest = Math.max(found.largest, value);
      found.sum += value;
      found.squares += value * value;
      found.count += 1;
    }
  }
  return found;
}

function statisticsRows(all) {
  const of = (kernel) => all.map((found) => (found.count ? rough(kernel(found)) : "–"));
  return [
    ["least", of((found) => found.least)],
    ["mean", of((found) => found.sum / found.count)],
    ["root mean square", of((found) => Math.sqrt(found.squares / found.count))],
    ["largest", of((found) => found.largest)],
    ["not finite, set aside", all.map((found) => String(found.strange))],
  ];
}

function makeStatistics(viewer) {
  const caption = element("caption");
  const table = element("table", {}, caption);
  const details = element(
    "details",
    {},
    element("summary", {}, say("Statistics of what is seen")),
    element("div", { className: "scroll", tabIndex: 0, role: "region", "aria-label": say("Statistics") }, table),
  );

  function fill() {
    if (!details.open) return;
    const layer = layerOf(viewer, viewer.current);
    const part = visiblePart(viewer);
    const names = layer.isTone ? [say("red"), say("green"), say("blue")] : [layerName(layer)];
    const all = names.map((_, channel) => channelStatistics(layer, channel, part, viewer.cell.width));
    caption.textContent = say("Columns {left} to {right}, rows {top} to {bottom}", {
      ...part,
      right: part.right - 1,
      bottom: part.bottom - 1,
    });
    const head = element("tr", {}, element("td"), ...names.map((name) => element("th", { scope: "col" }, name)));
    const rows = statisticsRows(all).map(([name, texts]) =>
      element("tr", {}, element("th", { scope: "row" }, say(name)), ...texts.map((text) => element("td", {}, text))),
    );
    table.replaceChildren(caption, element("thead", {}, head), element("tbody", {}, ...rows));
  }
  details.addEventListener("toggle", fill);
  viewer.listeners.push(fill);
  return details;
}
