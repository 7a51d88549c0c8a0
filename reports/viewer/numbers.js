"use strict";

// Numbers in words, and the distance of two floats.

function inWords(value, digits) {
  if (Number.isNaN(value)) return say("not a number");
  if (!Number.isFinite(value)) return value > 0 ? say("infinite") : say("−infinite");
  return String(Number(value.toPrecision(digits))); // with signs that other programs read
}

// Nine digits tell any two float32 numbers apart (Matula 1968).
const exact = (value) => inWords(value, 9);
const rough = (value) => inWords(value, 3);

// How many characters fit into a drawn pixel: four digits.
function short(value) {
  if (Number.isNaN(value)) return "NaN";
  if (!Number.isFinite(value)) return value > 0 ? "+∞" : "−∞";
  return inWords(value, 4);
}

const oneFloat = new Float32Array(1);
const itsBits = new Int32Array(oneFloat.buffer);

// The place of a float32 among all, in their order; both zeros have the same.
function ordinal(value) {
  oneFloat[0] = value;
  return itsBits[0] < 0 ? -(itsBits[0] & 0x7fffffff) : itsBits[0];
}

// How many bits of a float32 are wrong: the logarithm of how many floats lie between it and the truth (Panchekha et al.
// 2015, "Automatically Improving Accuracy for Floating Point Expressions", section 2).
function bitsOfError(value, truth) {
  if (Number.isNaN(value) || Number.isNaN(truth)) return 32;
  return Math.log2(1 + Math.abs(ordinal(value) - ordinal(truth)));
}
