"use strict";

// Float arrays, loaded when they are wanted: a page that was opened from a file may load scripts, but no data.

const delivered = new Map();
const loading = new Map();

// What those scripts call.
globalThis.raytruthArrays = (name, data) => delivered.set(name, data);

function loadScript(name) {
  return new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.src = `${document.body.dataset.base}${name}`;
    script.onload = resolve;
    script.onerror = () =>
      reject(
        new Error(
          say("The pixels’ values lie in the file {name} of the report’s folder, which is missing.", { name }),
        ),
      );
    document.head.append(script);
  });
}

async function inflated(text) {
  const bytes = Uint8Array.from(atob(text), (character) => character.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Bytes of the same significance stand together, the least significant ones first.
function numbersOf(bytes, kind) {
  if (kind === "u1") return bytes;
  const count = bytes.length / 4;
  const mixed = new Uint8Array(bytes.length);
  for (let plane = 0; plane < 4; plane += 1) {
    for (let i = 0; i < count; i += 1) mixed[4 * i + plane] = bytes[plane * count + i];
  }
  return new Float32Array(mixed.buffer);
}

async function fetched(name) {
  const inPage = document.getElementById(name);
  if (inPage) delivered.set(name, JSON.parse(inPage.textContent));
  else await loadScript(name);
  const data = delivered.get(name);
  delivered.delete(name); // its text is not needed again
  if (!data)
    throw new Error(say("The file {name} holds no values: build the report again with raytruth report.", { name }));
  const arrays = {};
  for (const [key, packed] of Object.entries(data)) {
    arrays[key] = numbersOf(await inflated(packed.bytes), packed.kind);
  }
  return arrays;
}

// All arrays of one file, by their names.
function loadArrays(name) {
  if (!loading.has(name)) loading.set(name, fetched(name));
  return loading.get(name);
}
