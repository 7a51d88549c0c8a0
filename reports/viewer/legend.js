"use strict";

// The scale bar below the panes, and the patterns that occur in what they show.

// Where numbers stand below the scale: in units of the tolerance at its limits, else at the ends and between.
function markedPlaces(layer, scale) {
  if (!layer.isJudged || scale.largest <= 1) return [0, 0.25, 0.5, 0.75, 1];
  return [0, position(-1, scale), position(1, scale), 1];
}

// The colours of the layer that is shown, with numbers, and the patterns that occur in it.
function makeLegend(viewer) {
  const bar = element("canvas", { width: TABLE_LENGTH, height: 1, role: "img" });
  const marks = element("span", { className: "marks" });
  const patterns = element("span", { className: "keys" });
  function fill() {
    const layer = layerOf(viewer, viewer.current);
    const isScalar = !layer.isTone || viewer.settings.falseColour;
    bar.hidden = marks.hidden = !isScalar;
    if (isScalar) {
      const scale = scaleOf(layer.isTone ? { ...layer, largest: 1 } : layer, viewer.settings);
      const pixels = new ImageData(TABLE_LENGTH, 1);
      const table = COLOURS_OF[scale.isDiverging ? "diverging" : "sequential"];
      for (let i = 0; i < TABLE_LENGTH; i += 1)
        pixels.data.set([...table.subarray(COLOURS * i, COLOURS * (i + 1)), 255], 4 * i);
      bar.getContext("2d").putImageData(pixels, 0, 0);
      marks.replaceChildren(
        ...markedPlaces(layer, scale).map((place) => {
          const mark = element("span", {}, rough(valueAt(place, scale)));
          mark.style.left = `${100 * place}%`;
          return mark;
        }),
      );
      bar.setAttribute(
        "aria-label",
        say("Scale from {low} to {high}", { low: rough(valueAt(0, scale)), high: rough(valueAt(1, scale)) }),
      );
    }
    const present = new Set(layer.classes);
    patterns.replaceChildren(
      ...Object.entries(PATTERNS)
        .filter(([kind]) => present.has(Number(kind)))
        .map(([kind, { name }]) =>
          element(
            "span",
            { className: "key" },
            element("span", { className: `swatch pattern-${kind}` }),
            ` ${say(name)}`,
          ),
        ),
    );
  }
  viewer.listeners.push(fill);
  return element("div", { className: "scale-bar" }, bar, marks, patterns);
}
