"use strict";

// One pixel in numbers: its value, its truth, and all that it may be.

const colourOf = (array, place) => [...array.subarray(COLOURS * place, COLOURS * (place + 1))];

function tableRow(header, cells, isNearest = false) {
  const inLines = (texts) => texts.flatMap((text) => [element("span", { className: "line" }, text), " "]);
  const row = element("tr", {}, element("th", { scope: "row" }, ...inLines(header)));
  for (const texts of cells) row.append(element("td", {}, ...inLines(texts)));
  row.classList.toggle("nearest", isNearest);
  return row;
}

function valueRows(viewer, place) {
  const { render, truth, distance } = viewer.arrays;
  const values = colourOf(render, place);
  const truths = colourOf(truth, place);
  const distances = colourOf(distance, place);
  const rows = [
    tableRow(
      [viewer.isJudged ? say(viewer.cell.isMean ? "Mean" : "Value") : viewer.cell.names[1]],
      values.map((value) => [exact(value)]),
    ),
    tableRow(
      [viewer.isJudged ? say("Truth") : viewer.cell.names[0]],
      truths.map((value) => [exact(value)]),
    ),
    tableRow(
      [say("Difference")],
      values.map((value, i) => [rough(value - truths[i])]),
    ),
    tableRow(
      [say("Bits of error")],
      values.map((value, i) => [bitsOfError(value, truths[i]).toFixed(1)]),
    ),
  ];
  if (distances[0] >= 0 || Number.isNaN(distances[0])) {
    rows.push(
      tableRow(
        [say("Distance")],
        distances.map((far) => [far <= 1 ? rough(far) : `✗ ${rough(far)}`]),
      ),
    );
  }
  for (const [id, layer] of viewer.images) {
    if (!id.startsWith("other")) continue;
    rows.push(
      tableRow(
        [layerName(layer)],
        colourOf(layer.values, place).map((value) => [exact(value)]),
      ),
    );
  }
  return rows;
}

function interval(low, high) {
  return low > high ? [say("no float32")] : [exact(low), exact(high)];
}

function outcomeRows(viewer, place) {
  const { outcomes, nearest, low, high } = viewer.arrays;
  const count = outcomes[place];
  if (count === 0) return [];
  const isInside = worstDistance(viewer, place) <= 1;
  let title = say("Feasible interval");
  if (viewer.cell.isMean) title = say("Feasible interval of the expectation");
  else if (count > 1)
    title = say("{count} feasible outcomes, from … to ({mark})", {
      count,
      mark: say(isInside ? "✓ holds the value" : "◂ is the nearest"),
    });
  const rows = [element("tr", {}, element("th", { scope: "rowgroup", colSpan: 1 + COLOURS }, title))];
  for (let outcome = 0; outcome < count; outcome += 1) {
    const box = viewer.firstBoxes[place] + outcome;
    const [lows, highs] = [colourOf(low, box), colourOf(high, box)];
    const isNearest = count > 1 && outcome === nearest[place];
    const mark = isNearest ? (isInside ? " ✓" : " ◂") : "";
    const header = count === 1 ? [say("from"), say("to")] : [`${outcome + 1}${mark}`];
    rows.push(
      tableRow(
        header,
        lows.map((end, i) => interval(end, highs[i])),
        isNearest,
      ),
    );
  }
  return rows;
}

// Boxes follow one another pixel by pixel: where each pixel's first one is.
function firstBoxes(outcomes) {
  const first = new Uint32Array(outcomes.length);
  for (let place = 1; place < first.length; place += 1) first[place] = first[place - 1] + outcomes[place - 1];
  return first;
}

function outcomeInWords(viewer, place) {
  const distance = worstDistance(viewer, place);
  if (!viewer.isJudged) {
    const [values, others] = [colourOf(viewer.arrays.render, place), colourOf(viewer.arrays.truth, place)];
    return say("they differ by {differences}", {
      differences: values.map((value, i) => rough(value - others[i])).join(", "),
    });
  }
  const count = viewer.arrays.outcomes[place];
  const far = rough(distance);
  const sentences = [];
  if (distance < 0) sentences.push(say("not judged, since the renderer’s arithmetic leaves everything open"));
  else if (viewer.cell.isMean) {
    const words =
      distance > 1
        ? "✗ its mean is too unlikely, at a distance of {far} where 1 is the significance"
        : "✓ its mean is likely enough, at a distance of {far} where 1 is the significance";
    sentences.push(say(words, { far }));
  } else if (count > 1) {
    const words =
      distance > 1
        ? "✗ outside its {count} feasible outcomes, {far} tolerances from the middle of the nearest"
        : "✓ within its {count} feasible outcomes, {far} tolerances from the middle of the nearest";
    sentences.push(say(words, { count, far }));
  } else {
    sentences.push(
      say(
        distance > 1
          ? "✗ outside its feasible interval, {far} tolerances from the middle"
          : "✓ within its feasible interval, {far} tolerances from the middle",
        { far },
      ),
    );
  }
  if (viewer.arrays.declared[place])
    sentences.push(say("◐ as declared, not as due: only a shortcut that the renderer declares explains it"));
  if (viewer.arrays.merged[place])
    sentences.push(say("capped: there are more outcomes than are told apart, and a box holds several"));
  return sentences.join(say("; "));
}

const READ_AFTER = 200; // milliseconds: a screen reader need not begin with pixels that the pointer only passes

function makePixelPanel(viewer) {
  const { width, height, explain } = viewer.cell;
  const coordinate = (size) =>
    element("input", { type: "number", min: 0, max: size - 1, step: 1, inputMode: "numeric" });
  const [xInput, yInput] = [coordinate(width), coordinate(height)];
  const status = element("p", { className: "outcome" });
  const spoken = element("p", { className: "visually-hidden", role: "status" });
  const body = element("tbody");
  const outcomes = element("tbody");
  const head = element(
    "tr",
    {},
    element("td"),
    ...["red", "green", "blue"].map((name) => element("th", { scope: "col" }, say(name))),
  );
  const table = element("table", {}, element("thead", {}, head), body, outcomes);
  const code = element("code");
  const command = element("div", { className: "command", translate: "no" }, element("pre", { tabIndex: 0 }, code));
  command.dataset.copy = "";
  addCopyButton(code);
  let timer = 0;

  function fill() {
    const { x, y } = viewer.pixel;
    const place = y * width + x;
    status.textContent = say("Pixel ({x}, {y}): {outcome}.", { x, y, outcome: outcomeInWords(viewer, place) });
    clearTimeout(timer);
    timer = setTimeout(() => {
      const values = colourOf(viewer.arrays.render, place).map(rough).join(", ");
      const truth = colourOf(viewer.arrays.truth, place).map(rough).join(", ");
      spoken.textContent = `${status.textContent} ${say("Value {values}; truth {truth}.", { values, truth })}`;
    }, READ_AFTER);
    if (document.activeElement !== xInput) xInput.value = x;
    if (document.activeElement !== yInput) yInput.value = y;
    body.replaceChildren(...valueRows(viewer, place));
    outcomes.replaceChildren(...outcomeRows(viewer, place));
    code.textContent = `${explain}${x},${y}`;
  }
  function typed() {
    viewer.isPinned = true;
    choosePixel(viewer, Number(xInput.value), Number(yInput.value));
    [xInput.value, yInput.value] = [viewer.pixel.x, viewer.pixel.y];
    bringIntoSight(viewer);
  }
  for (const input of [xInput, yInput]) input.addEventListener("change", typed);
  viewer.listeners.push(fill);
  return element(
    "section",
    { className: "pixel" },
    element(
      "div",
      { className: "choice" },
      element("h3", {}, say("Pixel")),
      element("label", {}, "x ", xInput),
      element("label", {}, "y ", yInput),
    ),
    status,
    spoken,
    element(
      "div",
      { className: "scroll", tabIndex: 0, role: "region", "aria-label": say("Values of the pixel") },
      table,
    ),
    ...(explain ? [element("p", { className: "label" }, say("To see how the pixel comes about:")), command] : []),
    ...(explain ? [makeProofPanel(viewer)] : []),
  );
}
