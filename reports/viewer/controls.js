"use strict";

// The controls of a viewer: layers, modes, zoom, exposure, scale, and what if the tolerance were another.

// Words of scenes and renderers stay as they are; ours are translated.
const layerName = (layer) => (layer.isName ? layer.name : say(layer.name));

function choiceOf(label, options, chosen, change) {
  const menu = element("select", {}, ...options.map(([value, name]) => element("option", { value }, say(name))));
  menu.value = chosen;
  menu.addEventListener("change", () => change(menu.value));
  return [element("label", {}, element("span", {}, say(label)), " ", menu), menu];
}

function sliderOf(label, { min, max, step, value }, words, change) {
  const input = element("input", { type: "range", min, max, step, value });
  const told = element("output", {}, words(value));
  const set = (number) => {
    input.value = number;
    told.textContent = words(Number(input.value));
    input.setAttribute("aria-valuetext", told.textContent);
    change(Number(input.value));
  };
  input.addEventListener("input", () => set(Number(input.value)));
  return {
    label: element("label", {}, element("span", {}, say(label)), " ", input, " ", told),
    set,
    get: () => Number(input.value),
  };
}

function layerButtons(viewer, layers) {
  const bar = element("div", { className: "tools layers", role: "group", "aria-label": say("Layers") });
  layers.forEach(({ id, name, isName }, index) => {
    const key = index < 9 ? String(index + 1) : undefined;
    const shown = isName ? name : say(name);
    const command = { name: shown, key, run: () => show(viewer, id) };
    const button = commandButton(command, shown);
    viewer.commands.push({ ...command, name: say("Show: {layer}", { layer: shown }) });
    viewer.listeners.push(() => button.setAttribute("aria-pressed", String((viewer.held ?? viewer.current) === id)));
    bar.append(button);
  });
  return bar;
}

function viewCommands(viewer) {
  const move = (x, y) => (event) => {
    const step = event?.shiftKey ? 10 : 1;
    viewer.isPinned = true;
    choosePixel(viewer, viewer.pixel.x + step * x, viewer.pixel.y + step * y);
    bringIntoSight(viewer);
  };
  const where = (target) => target === viewer.stage; // elsewhere the arrow keys scroll the page
  return [
    { name: "Zoom in", key: "+", run: () => zoomAtPixel(viewer, 2) },
    { name: "Zoom out", key: "-", run: () => zoomAtPixel(viewer, 1 / 2) },
    { name: "Fit the whole image", key: "0", run: () => fit(viewer) },
    { name: "Zoom to the numbers of the pixel", key: "z", run: () => centreOnPixel(viewer, LEAST_FOR_NUMBERS * 1.5) },
    { name: "Centre on the pixel", key: "c", run: () => centreOnPixel(viewer) },
    { name: "Pixel to the left", key: "ArrowLeft", run: move(-1, 0), where },
    { name: "Pixel to the right", key: "ArrowRight", run: move(1, 0), where },
    { name: "Pixel above", key: "ArrowUp", run: move(0, -1), where },
    { name: "Pixel below", key: "ArrowDown", run: move(0, 1), where },
    { name: "Look to the left", key: "H", run: () => pan(viewer, -0.25, 0) },
    { name: "Look to the right", key: "L", run: () => pan(viewer, 0.25, 0) },
    { name: "Look up", key: "K", run: () => pan(viewer, 0, -0.25) },
    { name: "Look down", key: "J", run: () => pan(viewer, 0, 0.25) },
    {
      name: "Follow the pointer again",
      key: "Escape",
      run: () => {
        viewer.isPinned = false;
      },
    },
  ];
}

function flipCommands(viewer) {
  const hold = (id) => {
    viewer.held = id;
    refresh(viewer);
  };
  return [
    { name: "Hold for the truth", key: "t", run: () => hold("truth"), release: () => hold(null) },
    { name: "Flip to the layer before", key: " ", run: () => show(viewer, viewer.previous) },
    {
      name: "Flip, slider or side by side",
      key: "v",
      run: () => setMode(viewer, MODES[(MODES.indexOf(viewer.mode) + 1) % MODES.length]),
    },
  ];
}

function setMode(viewer, mode) {
  viewer.mode = mode;
  refresh(viewer);
}

const stopsInWords = (stops) => `${stops > 0 ? "+" : ""}${stops}`.replace("-", "−");

function toneControls(viewer) {
  const { settings } = viewer;
  const change = (name) => (value) => {
    settings[name] = value;
    refresh(viewer);
  };
  const exposure = sliderOf(
    "Exposure",
    { min: -12, max: 12, step: 0.5, value: settings.exposure },
    stopsInWords,
    change("exposure"),
  );
  const gain = sliderOf(
    "Gain of differences",
    { min: -6, max: 24, step: 1, value: 0 },
    (stops) => `×${rough(2 ** stops)}`,
    change("gain"),
  );
  const [gamma] = choiceOf(
    "Curve",
    [
      ["0", "sRGB"],
      ["1", "linear"],
      ["2.2", "gamma 2.2"],
    ],
    "0",
    (value) => change("gamma")(Number(value)),
  );
  const [kind] = choiceOf(
    "Scale",
    [
      ["automatic", "automatic"],
      ["linear", "linear"],
      ["logarithmic", "logarithmic"],
      ["symmetric", "symmetric logarithm"],
    ],
    "automatic",
    change("scaleKind"),
  );
  const [channel] = choiceOf(
    "Channel",
    [
      ["-1", "largest of all"],
      ["0", "red"],
      ["1", "green"],
      ["2", "blue"],
    ],
    "-1",
    (value) => change("channel")(Number(value)),
  );
  const isFalse = element("input", { type: "checkbox" });
  isFalse.addEventListener("change", () => change("falseColour")(isFalse.checked));
  viewer.commands.push(
    { name: "More exposure", key: "e", run: () => exposure.set(exposure.get() + 0.5) },
    { name: "Less exposure", key: "E", run: () => exposure.set(exposure.get() - 0.5) },
    { name: "More gain of differences", key: "g", run: () => gain.set(gain.get() + 1) },
    { name: "Less gain of differences", key: "G", run: () => gain.set(gain.get() - 1) },
    { name: "False colour", key: "f", run: () => isFalse.click() },
  );
  return [
    exposure.label,
    gamma,
    element("label", {}, isFalse, " ", element("span", {}, say("False colour"))),
    kind,
    gain.label,
    channel,
  ];
}

function toleranceControls(viewer) {
  const LARGEST = 64; // powers of two, in quarters: past 2**16 a tolerance of float32 is everything
  const words = (quarter) => `×${rough(2 ** (quarter / 4))}`;
  const slider = sliderOf(
    "If the tolerance were",
    { min: -LARGEST / 4, max: LARGEST, step: 1, value: 0 },
    words,
    (quarter) => {
      viewer.tolerance = 2 ** (quarter / 4);
      refresh(viewer);
    },
  );
  const isMasked = element("input", { type: "checkbox" });
  isMasked.addEventListener("change", () => {
    viewer.isMasked = isMasked.checked;
    refresh(viewer);
  });
  viewer.commands.push(
    { name: "Mark failing pixels", key: "m", run: () => isMasked.click() },
    { name: "Larger tolerance", key: "k", run: () => slider.set(slider.get() + 1) },
    { name: "Smaller tolerance", key: "j", run: () => slider.set(slider.get() - 1) },
    { name: "The tolerance as it is", run: () => slider.set(0) },
  );
  return [element("label", {}, isMasked, " ", element("span", {}, say("Mark failing pixels"))), slider.label];
}

function modeControls(viewer) {
  const [label, menu] = choiceOf(
    "View",
    MODES.map((mode) => [mode, mode]),
    viewer.mode,
    (mode) => setMode(viewer, mode),
  );
  const divider = sliderOf(
    "Divider",
    { min: 0, max: 100, step: 1, value: 50 },
    (part) => `${part} %`,
    (part) => {
      viewer.divider = part / 100;
      refresh(viewer);
    },
  );
  viewer.commands.push(
    { name: "Divider to the left", key: "[", run: () => divider.set(divider.get() - 5) },
    { name: "Divider to the right", key: "]", run: () => divider.set(divider.get() + 5) },
  );
  viewer.listeners.push(() => {
    menu.value = viewer.mode;
    divider.label.hidden = viewer.mode !== "slider";
  });
  return [label, divider.label];
}
