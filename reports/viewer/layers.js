"use strict";

// What can be looked at: images and differences. A layer is {id, name, isTone, values, classes, largest, …}, with
// three values a pixel where it is an image, and one where it is not.

const COLOURS = 3;

function classOf(value) {
  if (Number.isNaN(value)) return NOT_A_NUMBER;
  if (value === Infinity) return INFINITE;
  return value === -Infinity ? MINUS_INFINITE : ORDINARY;
}

function toneLayer(id, name, values) {
  const classes = new Uint8Array(values.length / COLOURS);
  for (let place = 0; place < classes.length; place += 1) {
    for (let i = COLOURS * place; i < COLOURS * (place + 1); i += 1) {
      const kind = values[i] < 0 && values[i] !== -Infinity ? NEGATIVE : classOf(values[i]);
      if (kind !== ORDINARY && (classes[place] === ORDINARY || kind < classes[place])) classes[place] = kind;
    }
  }
  return {
    id,
    name,
    isTone: true,
    values,
    classes,
    largest: largestOf(values),
    isDiverging: false,
    scaleKind: "linear",
  };
}

function largestOf(values) {
  let largest = 0;
  for (const value of values) {
    const size = Math.abs(value);
    if (size > largest && size !== Infinity) largest = size;
  }
  return largest;
}

// `kernel(render, truth, distance)` is the number of one channel; `channel` chooses one, or is -1 for the largest.
function fieldLayer(arrays, channel, { id, name, kernel, ...rest }) {
  const count = arrays.truth.length / COLOURS;
  const values = new Float32Array(count);
  const classes = new Uint8Array(count);
  for (let place = 0; place < count; place += 1) {
    const first = COLOURS * place;
    let chosen = 0;
    if (rest.isJudged && arrays.distance[first] < 0) classes[place] = UNJUDGED;
    else {
      for (let c = 0; c < COLOURS; c += 1) {
        if (channel >= 0 && c !== channel) continue;
        const value = kernel(arrays.render[first + c], arrays.truth[first + c], arrays.distance[first + c]);
        const isFirst = c === Math.max(channel, 0);
        if (isFirst || Number.isNaN(value) || Math.abs(value) > Math.abs(chosen)) chosen = value;
        if (Number.isNaN(value)) break; // counts as the largest
      }
      classes[place] = classOf(chosen);
    }
    values[place] = chosen;
  }
  return { id, name, isTone: false, values, classes, largest: largestOf(values), ...rest };
}

function relativeDifference(value, truth) {
  return value === truth ? 0 : (value - truth) / Math.abs(truth);
}

// The side of the truth that the value is on gives the distance its sign.
const signedDistance = (value, truth, distance) => (value < truth ? -distance : distance);

const FIELDS = [
  {
    id: "tolerance",
    name: "Error in tolerances",
    kernel: signedDistance,
    isDiverging: true,
    scaleKind: "symmetric",
    threshold: 1,
    isJudged: true,
  },
  { id: "signed", name: "Signed difference", kernel: (v, t) => v - t, isDiverging: true, scaleKind: "linear" },
  {
    id: "absolute",
    name: "Absolute difference",
    kernel: (v, t) => Math.abs(v - t),
    isDiverging: false,
    scaleKind: "logarithmic",
  },
  {
    id: "relative",
    name: "Relative difference",
    kernel: relativeDifference,
    isDiverging: true,
    scaleKind: "symmetric",
  },
];

// Both keep within what a person looks at: no field is made before it is wanted.
function fieldOf(viewer, id) {
  const key = `${id} ${viewer.settings.channel}`;
  if (!viewer.fields.has(key)) {
    const made = fieldLayer(
      viewer.arrays,
      viewer.settings.channel,
      FIELDS.find((field) => field.id === id),
    );
    viewer.fields.set(key, made);
  }
  return viewer.fields.get(key);
}

function deviationLayer(variance, count) {
  const channels = variance.length / count;
  const values = new Float32Array(count);
  for (let place = 0; place < count; place += 1) {
    values[place] = Math.sqrt(Math.max(...variance.subarray(channels * place, channels * (place + 1))));
  }
  const classes = Uint8Array.from(values, classOf);
  return {
    id: "deviation",
    name: "Standard deviation",
    isTone: false,
    values,
    classes,
    largest: largestOf(values),
    isDiverging: false,
    scaleKind: "linear",
  };
}

function layerOf(viewer, id) {
  return viewer.images.get(id) ?? fieldOf(viewer, id);
}
