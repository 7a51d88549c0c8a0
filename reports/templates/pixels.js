// A pixel of a cell, looked at closely. Its numbers lie in a script beside the page, which is loaded when they are wanted.

const delivered = new Map();

// What those scripts call.
globalThis.raytruthPixels = (cell, data) => delivered.set(cell, data);

const COLOURS = 3;

async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Response(stream).arrayBuffer();
}

function loadScript(address) {
  return new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.src = address;
    script.onload = resolve;
    script.onerror = () =>
      reject(new Error(`The pixels’ values lie in the file ${decodeURIComponent(address)} beside this page, which is missing.`));
    document.head.append(script);
  });
}

async function loadPixels(pictures, cell) {
  const { width, height } = pictures.dataset;
  await loadScript(pictures.dataset.pixels);
  const data = delivered.get(cell);
  if (data?.width !== Number(width) || data.height !== Number(height)) {
    throw new Error("The pixels’ values beside this page belong to another report: build it again with raytruth report.");
  }
  const pixels = {};
  for (const name of ["value", "truth", "distance", "low", "high"]) {
    pixels[name] = new Float32Array(await unpacked(data[name]));
  }
  for (const name of ["outcomes", "nearest", "merged", "declared"]) {
    pixels[name] = new Uint8Array(await unpacked(data[name]));
  }
  // Boxes follow one another pixel by pixel: where each pixel's first one is.
  pixels.first = new Uint32Array(pixels.outcomes.length);
  for (let place = 1; place < pixels.first.length; place += 1) {
    pixels.first[place] = pixels.first[place - 1] + pixels.outcomes[place - 1];
  }
  return pixels;
}

function inWords(value, digits) {
  if (Number.isNaN(value)) return "not a number";
  if (!Number.isFinite(value)) return value > 0 ? "infinite" : "−infinite";
  return String(Number(value.toPrecision(digits)));
}

// Nine digits tell any two float32 numbers apart.
const exact = (value) => inWords(value, 9);
const rough = (value) => inWords(value, 3);

function lines(cell, ...texts) {
  for (const text of texts) {
    const line = document.createElement("span");
    line.className = "line";
    line.textContent = text;
    cell.append(line, " ");
  }
}

function addHeading(row, scope, ...texts) {
  const heading = document.createElement("th");
  heading.scope = scope;
  lines(heading, ...texts);
  row.append(heading);
  return heading;
}

function addRow(body, header, cells) {
  const row = body.insertRow();
  addHeading(row, "row", ...header);
  for (const texts of cells) {
    lines(row.insertCell(), ...texts);
  }
  return row;
}

const colours = (array, place) => [...array.subarray(COLOURS * place, COLOURS * (place + 1))];

function interval(low, high) {
  if (low > high) return ["no float32"];
  return [exact(low), exact(high)];
}

function fillValues(body, pixels, place, isMean) {
  body.replaceChildren();
  addRow(body, [isMean ? "Mean" : "Value"], colours(pixels.value, place).map((value) => [exact(value)]));
  addRow(body, ["Truth"], colours(pixels.truth, place).map((value) => [exact(value)]));
  const distances = colours(pixels.distance, place);
  if (distances[0] >= 0) {
    addRow(body, ["Distance"], distances.map((distance) => [distance > 1 ? `✗ ${rough(distance)}` : rough(distance)]));
  }
}

function fillOutcomes(body, pixels, place, isMean) {
  body.replaceChildren();
  const count = pixels.outcomes[place];
  if (count === 0) return;
  const isInside = Math.max(...colours(pixels.distance, place)) <= 1;
  const several = `${count} feasible outcomes, from … to (${isInside ? "✓ holds the value" : "◂ is the nearest"})`;
  const title = isMean ? "Feasible interval of the expectation" : count === 1 ? "Feasible interval" : several;
  addHeading(body.insertRow(), "rowgroup", title).colSpan = 1 + COLOURS;
  for (let outcome = 0; outcome < count; outcome += 1) {
    const box = pixels.first[place] + outcome;
    const low = colours(pixels.low, box);
    const high = colours(pixels.high, box);
    const isNearest = count > 1 && outcome === pixels.nearest[place];
    const mark = isNearest ? (isInside ? " ✓" : " ◂") : "";
    const header = count === 1 ? ["from", "to"] : [`${outcome + 1}${mark}`];
    const row = addRow(body, header, low.map((end, i) => interval(end, high[i])));
    row.classList.toggle("nearest", isNearest);
  }
}

function outcomeInWords(pixels, place, isMean) {
  const distance = Math.max(...colours(pixels.distance, place));
  const count = pixels.outcomes[place];
  const sentences = [];
  if (distance < 0) {
    sentences.push("not judged, since the renderer’s arithmetic leaves everything open");
  } else if (isMean) {
    const verdict = distance > 1 ? "✗ its mean is too unlikely" : "✓ its mean is likely enough";
    sentences.push(`${verdict}, at a distance of ${rough(distance)} where 1 is the significance`);
  } else {
    const verdict = distance > 1 ? "✗ outside " : "✓ within ";
    const set = count > 1 ? `its ${count} feasible outcomes` : "its feasible interval";
    sentences.push(`${verdict}${set}, ${rough(distance)} tolerances from the middle${count > 1 ? " of the nearest" : ""}`);
  }
  if (pixels.declared[place]) {
    sentences.push("◐ as declared, not as due: only a shortcut that the renderer declares explains it");
  }
  if (pixels.merged[place]) {
    sentences.push("capped: there are more outcomes than are told apart, and a box holds several");
  }
  return sentences.join("; ");
}

function inspect(pictures) {
  const cell = pictures.closest("article").id;
  const width = Number(pictures.dataset.width);
  const height = Number(pictures.dataset.height);
  const isMean = "mean" in pictures.dataset;
  const panel = document.getElementById("pixel-panel").content.firstElementChild.cloneNode(true);
  const [xInput, yInput] = panel.querySelectorAll("input");
  const status = panel.querySelector(".outcome");
  const frames = [...pictures.querySelectorAll(".frame")];
  const markers = frames.map((frame) => frame.appendChild(document.createElement("span")));
  let chosen = { x: Number(pictures.dataset.x), y: Number(pictures.dataset.y) };
  let pinned = false;
  let loading = null;

  function fill(pixels) {
    const place = chosen.y * width + chosen.x;
    status.textContent = `Pixel (${chosen.x}, ${chosen.y}): ${outcomeInWords(pixels, place, isMean)}.`;
    const [values, outcomes] = panel.querySelectorAll("tbody");
    fillValues(values, pixels, place, isMean);
    fillOutcomes(outcomes, pixels, place, isMean);
    panel.querySelector("code").textContent = `${pictures.dataset.explain}${chosen.x},${chosen.y}`;
    panel.querySelector(".values").hidden = false;
  }

  function complain(error) {
    status.textContent = error.message;
    status.classList.add("problem");
  }

  function showChoice() {
    xInput.value = chosen.x;
    yInput.value = chosen.y;
    pictures.classList.toggle("pinned", pinned);
    for (const marker of markers) {
      marker.className = "marker";
      marker.style.left = `${(100 * chosen.x) / width}%`;
      marker.style.top = `${(100 * chosen.y) / height}%`;
      marker.style.width = `${100 / width}%`;
      marker.style.height = `${100 / height}%`;
    }
  }

  function choose(x, y) {
    const within = (value, size) => Math.min(Math.max(Math.trunc(value) || 0, 0), size - 1);
    chosen = { x: within(x, width), y: within(y, height) };
    panel.classList.add("open");
    showChoice();
    loading ??= loadPixels(pictures, cell);
    loading.then(fill).catch(complain);
  }

  function pixelAt(frame, event) {
    const box = frame.querySelector(".picture").getBoundingClientRect();
    return [((event.clientX - box.left) / box.width) * width, ((event.clientY - box.top) / box.height) * height];
  }

  for (const frame of frames) {
    frame.addEventListener("pointermove", (event) => {
      if (!pinned && event.pointerType === "mouse") choose(...pixelAt(frame, event));
    });
    frame.addEventListener("click", (event) => {
      pinned = true;
      choose(...pixelAt(frame, event));
    });
    frame.addEventListener("keydown", (event) => {
      const step = event.shiftKey ? 10 : 1;
      const steps = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] };
      if (event.key === "Escape") {
        pinned = false;
        showChoice();
      } else if (event.key in steps && !event.ctrlKey && !event.altKey && !event.metaKey) {
        event.preventDefault(); // the page would scroll
        pinned = true;
        choose(chosen.x + steps[event.key][0], chosen.y + steps[event.key][1]);
      }
    });
    frame.setAttribute("role", "application"); // so that a screen reader passes on the arrow keys
    frame.setAttribute("aria-label", `${frame.dataset.title}: choose a pixel with the arrow keys`);
    frame.tabIndex = frame === frames[0] ? 0 : -1; // one stop of the Tab key a cell; a click focuses any
  }
  for (const [input, size] of [[xInput, width], [yInput, height]]) {
    input.max = size - 1;
    input.addEventListener("change", () => {
      pinned = true;
      choose(Number(xInput.value), Number(yInput.value));
    });
  }
  xInput.value = chosen.x;
  yInput.value = chosen.y;
  addCopyButton(panel.querySelector("[data-copy] code"));
  pictures.append(panel);
}

for (const pictures of document.querySelectorAll("[data-pixels]")) {
  inspect(pictures);
}
