"use strict";

// A viewer for each cell that is on the page, made when it comes into sight; the pictures are there before it.

let activeViewer = null;

// Of two images of which nothing is known.
function nothingJudged(count) {
  const none = () => new Uint8Array(count);
  return {
    distance: new Float32Array(COLOURS * count).fill(-1),
    outcomes: none(),
    nearest: none(),
    merged: none(),
    declared: none(),
  };
}

async function allArrays(cell) {
  const [truth, render] = await Promise.all(["truth", "render"].map((name) => loadArrays(cell.arrays[name])));
  const judgement = cell.arrays.judgement
    ? await loadArrays(cell.arrays.judgement)
    : nothingJudged(cell.width * cell.height);
  const arrays = { ...judgement, truth: truth.value, render: render.value };
  if (arrays.truth.length !== COLOURS * cell.width * cell.height || arrays.render.length !== arrays.truth.length) {
    throw new Error(
      say("The pixels’ values beside this page belong to another report: build it again with raytruth report."),
    );
  }
  if (cell.arrays.variance) arrays.variance = (await loadArrays(cell.arrays.variance)).value;
  return arrays;
}

function newViewer(host, cell, arrays) {
  const { arrays: _, ...known } = cell;
  const images = new Map([
    ["truth", { ...toneLayer("truth", cell.names?.[0] ?? "Truth", arrays.truth), isName: Boolean(cell.names) }],
    ["render", { ...toneLayer("render", cell.names?.[1] ?? "Render", arrays.render), isName: Boolean(cell.names) }],
  ]);
  if (arrays.variance) images.set("deviation", deviationLayer(arrays.variance, cell.width * cell.height));
  return {
    host,
    cell: known,
    isJudged: Boolean(cell.arrays.judgement),
    arrays,
    images,
    fields: new Map(),
    firstBoxes: firstBoxes(arrays.outcomes),
    painter: makePainter(cell.width, cell.height),
    panes: [],
    commands: [],
    listeners: [],
    stage: element("div", {
      className: "stage",
      tabIndex: 0,
      role: "application",
      "aria-label": say("Pixels: choose one with the arrow keys"),
    }),
    current: "render",
    previous: "truth",
    held: null,
    mode: "flip",
    divider: 0.5,
    view: { x: 0, y: 0, scale: 1 },
    pixel: { x: cell.worst[0], y: cell.worst[1] },
    isPinned: false,
    isMasked: false,
    tolerance: 1,
    settings: { exposure: cell.stops, gamma: 0, falseColour: false, scaleKind: "automatic", gain: 0, channel: -1 },
  };
}

function layerList(viewer) {
  return [
    viewer.images.get("truth"),
    viewer.images.get("render"),
    ...FIELDS.filter(({ isJudged }) => viewer.isJudged || !isJudged),
    ...[...viewer.images.values()].filter(({ id }) => id === "deviation"),
  ];
}

// Renders of the same scene by others are loaded when one of them is chosen.
function otherRenders(viewer) {
  const { others } = viewer.cell;
  if (others.length === 0) return [];
  const options = [["", "none"], ...others.map(({ name }, index) => [String(index), name])];
  const [label] = choiceOf("Another renderer", options, "", async (index) => {
    if (index === "") return;
    const { name, arrays } = others[Number(index)];
    const id = `other${index}`;
    try {
      const { value } = await loadArrays(arrays);
      if (value.length !== viewer.arrays.truth.length)
        throw new Error(say("The render of {name} has another size.", { name }));
      if (!viewer.images.has(id)) viewer.images.set(id, { ...toneLayer(id, name, value), isName: true });
      show(viewer, id);
    } catch (error) {
      complain(viewer.host, error);
    }
  });
  return [label];
}

// For fingers and mice what holding the key `t` is on the keyboard, where pressing the button shows the layer.
function holdButton(viewer) {
  const { run, release, name } = viewer.commands.find(({ key }) => key === "t");
  const button = element(
    "button",
    { type: "button", title: say(name) },
    say("Truth"),
    " ",
    element("kbd", { "aria-hidden": "true" }, "t"),
  );
  button.addEventListener("pointerdown", run);
  for (const ending of ["pointerup", "pointerleave", "pointercancel", "blur"]) button.addEventListener(ending, release);
  button.addEventListener("click", (event) => {
    if (event.detail === 0) show(viewer, "truth"); // pressed by a key
  });
  return button;
}

const SIGNS = {
  "+": "+",
  "-": "−",
  0: "Fit",
  z: "Numbers",
  c: "Centre",
  H: "←",
  L: "→",
  K: "↑",
  J: "↓",
  p: "✗ ←",
  n: "✗ →",
};

function build(viewer) {
  const regions = makeRegions(viewer);
  viewer.commands.push(...flipCommands(viewer), ...viewCommands(viewer), ...regions.commands);
  const buttons = Object.entries(SIGNS)
    .filter(([key]) => viewer.isJudged || !"np".includes(key))
    .map(([key, sign]) => {
      const command = viewer.commands.find((known) => known.key === key);
      return commandButton({ ...command, key: undefined }, say(sign));
    });
  viewer.host.append(
    layerButtons(viewer, layerList(viewer)),
    viewer.stage,
    makeLegend(viewer),
    element(
      "div",
      { className: "tools", role: "group", "aria-label": say("View") },
      ...modeControls(viewer),
      ...otherRenders(viewer),
      holdButton(viewer),
      ...buttons,
    ),
    element("div", { className: "tools", role: "group", "aria-label": say("Colours") }, ...toneControls(viewer)),
    ...(viewer.isJudged
      ? [
          element(
            "div",
            { className: "tools", role: "group", "aria-label": say("Tolerance") },
            ...toleranceControls(viewer),
          ),
        ]
      : []),
    element(
      "div",
      { className: "panels" },
      makePixelPanel(viewer),
      element("div", {}, ...(viewer.isJudged ? [regions.panel] : []), makeStatistics(viewer)),
    ),
  );
  viewer.stage.addEventListener("focus", () => activate(viewer));
  viewer.host.hidden = false;
}

// Of several viewers on a page the commands are those of the one that was used last.
function activate(viewer) {
  if (activeViewer === viewer) return;
  for (const command of activeViewer?.commands ?? []) commands.splice(commands.indexOf(command), 1);
  activeViewer = viewer;
  addCommands(...viewer.commands);
}

function complain(host, error) {
  host.hidden = false;
  host.append(element("p", { className: "problem", role: "alert" }, error.message));
}

async function start(host) {
  const cell = JSON.parse(host.parentElement.querySelector(".viewer-data").textContent);
  try {
    const viewer = newViewer(host, cell, await allArrays(cell));
    build(viewer);
    activate(viewer);
    layOut(viewer);
    fit(viewer);
    if (document.querySelector(".one-cell")) {
      readAddress(viewer);
      let timer = 0;
      viewer.listeners.push(() => {
        clearTimeout(timer);
        timer = setTimeout(writeAddress, 300, viewer); // browsers refuse addresses that change many times a second
      });
    }
    new ResizeObserver(() => {
      layOut(viewer);
      if (viewer.isFitted) fit(viewer);
      else refresh(viewer);
    }).observe(viewer.stage);
    host.parentElement.querySelector(".figures")?.classList.add("replaced");
    host.viewer = viewer;
  } catch (error) {
    complain(host, error);
  }
}

function startViewers() {
  const observer = new IntersectionObserver((entries) => {
    for (const { isIntersecting, target } of entries) {
      if (!isIntersecting) continue;
      observer.unobserve(target);
      start(target);
    }
  });
  for (const host of document.querySelectorAll(".viewer")) {
    host.hidden = false;
    observer.observe(host);
  }
}

startViewers();
