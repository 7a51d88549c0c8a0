"use strict";

// The page is complete without this script; it adds the filters, the copy buttons and the single pixels.

const boxes = [...document.querySelectorAll(".verdicts input")];
const cells = [...document.querySelectorAll("[data-verdict]")];
const groups = [...document.querySelectorAll("[data-group]")];
const announcement = document.getElementById("filter-result");

function applyFilters() {
  const shown = new Set(boxes.filter((box) => box.checked).map((box) => box.value));
  for (const cell of cells) {
    cell.classList.toggle("filtered", !shown.has(cell.dataset.verdict));
  }
  for (const group of groups) {
    const members = [...group.querySelectorAll("[data-verdict]")];
    const empty = members.length > 0 && members.every((member) => member.classList.contains("filtered"));
    group.classList.toggle("filtered", empty);
  }
  const details = cells.filter((cell) => cell.matches("article"));
  const visible = details.filter((cell) => !cell.classList.contains("filtered")).length;
  announcement.textContent =
    visible === details.length ? "" : `Showing ${visible} of ${details.length} cells.`;
}

for (const box of boxes) {
  box.disabled = false;
  box.addEventListener("change", applyFilters);
}
applyFilters(); // a browser may restore the boxes of an earlier visit

function select(element) {
  const range = document.createRange();
  range.selectNodeContents(element);
  const selection = window.getSelection();
  selection.removeAllRanges();
  selection.addRange(range);
}

async function copy(code, button) {
  try {
    await navigator.clipboard.writeText(code.textContent);
    button.textContent = "Copied";
  } catch {
    select(code);
    button.textContent = "Selected: press Ctrl+C";
  }
}

function addCopyButton(code) {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = "Copy";
  button.setAttribute("aria-label", "Copy the command");
  button.addEventListener("click", () => {
    button.removeAttribute("aria-label"); // its text now tells the outcome
    copy(code, button);
  });
  code.closest("[data-copy]").append(button);
}

for (const code of document.querySelectorAll("[data-copy] code")) {
  addCopyButton(code);
}
