"use strict";

// The ray tree of a pixel, from a proof that `raytruth explain --proof` wrote and that the reader opens. It is read here
// and goes nowhere; whether it holds only `raytruth explain --check` can tell.

const LARGEST_PROOF = 64 * 2 ** 20; // bytes, as the command takes
const MOST_RAYS = 2000; // more are not read by a person, and slow to draw

const inBrackets = (colour) => `(${colour.map((value) => rough(Number(value))).join(", ")})`;

function hitInWords(ray) {
  if (!ray.hit) return say("meets nothing");
  const { material, primitive, distance } = ray.hit;
  return say("meets {material}, primitive {primitive}, at distance {distance}", {
    material: String(material),
    primitive: Number(primitive),
    distance: rough(Number(distance)),
  });
}

function lightInWords({ light, shadowed, occluder, radiance }) {
  const values = { light: Number(light), radiance: inBrackets(radiance), occluder: Number(occluder) };
  if (shadowed === null) return say("light {light}: behind the surface", values);
  return say(shadowed ? "light {light}: hidden by primitive {occluder}" : "light {light}: sends {radiance}", values);
}

const KIND_WORDS = { camera: "camera ray", reflected: "reflected ray", transmitted: "transmitted ray" };

function rayItem(ray) {
  const words = { ray: say(KIND_WORDS[ray.kind]), hit: hitInWords(ray), adds: inBrackets(ray.contribution) };
  const weight = say("weight {weight}", { weight: inBrackets(ray.weight) });
  const title = element(
    "span",
    {},
    say("{ray}: {hit}; adds {adds}", words),
    " ",
    element("span", { className: "soft" }, weight),
  );
  const inner = element(
    "ul",
    {},
    ...ray.lights.map((light) => element("li", { className: "soft" }, lightInWords(light))),
  );
  return { item: element("li", {}, title, inner), inner };
}

// Throws where the file is no proof; its numbers are shown as it states them.
function proofTree({ low, high, explanation }) {
  const { sum, rays } = explanation;
  if (rays.length > MOST_RAYS)
    throw new Error(say("The tree has {count} rays, too many to be shown.", { count: rays.length }));
  const root = element("ul", { className: "tree" });
  const inside = new Map();
  for (const ray of rays) {
    const { item, inner } = rayItem(ray);
    (ray.parent === null ? root : inside.get(ray.parent)).append(item);
    inside.set(ray.number, inner);
  }
  const values = {
    sum: inBrackets(sum),
    low: low.map(Number).map(exact).join(", "),
    high: high.map(Number).map(exact).join(", "),
  };
  const total = say(
    "Sum of all contributions: {sum}. The truth is claimed to lie between ({low}) and ({high}).",
    values,
  );
  return [element("p", {}, total), root];
}

function makeProofPanel(viewer) {
  const input = element("input", { type: "file", accept: ".json,application/json" });
  const shown = element("div", { role: "status" });
  const hint = say("Add --proof proof.json to the command above, and open that file here:");
  async function open() {
    const [file] = input.files;
    if (!file) return;
    try {
      if (file.size > LARGEST_PROOF) throw new Error(say("The file is too large for a proof."));
      const proof = JSON.parse(await file.text());
      const tree = proofTree(proof);
      viewer.isPinned = true;
      choosePixel(viewer, Number(proof.explanation.x), Number(proof.explanation.y));
      shown.replaceChildren(...tree);
    } catch (error) {
      const reason =
        error instanceof TypeError || error instanceof SyntaxError
          ? say("The file is no proof of a pixel.")
          : error.message;
      shown.replaceChildren(element("p", { className: "problem" }, reason));
    }
  }
  input.addEventListener("change", open);
  return element("details", {}, element("summary", {}, say("Ray tree")), element("label", {}, hint, " ", input), shown);
}
