"use strict";

// The filters of the overview, which is complete without them.

function startOverview() {
  const boxes = [...document.querySelectorAll(".verdicts input")];
  const cells = [...document.querySelectorAll("[data-verdict]")].filter((cell) => cell.closest(".matrix"));
  const rows = [...document.querySelectorAll(".matrix [data-scene]")];
  const sections = [...document.querySelectorAll("section.scene")];
  const announcement = document.getElementById("filter-result");
  const [text, renderer, feature, clause] = ["text", "renderer", "feature", "clause"].map((name) =>
    document.getElementById(`filter-${name}`),
  );
  const words = new Map(
    cells.map((cell) => [
      cell,
      `${cell.closest("tr").dataset.scene} ${cell.dataset.renderer} ${cell.title}`.toLowerCase(),
    ]),
  );

  function apply() {
    const verdicts = new Set(boxes.filter((box) => box.checked).map((box) => box.value));
    const wanted = text.value.trim().toLowerCase();
    let shown = 0;
    for (const row of rows) {
      const has = (listed, choice) => !choice?.value || listed.split("|").includes(choice.value);
      const isChosen = has(row.dataset.features, feature) && has(row.dataset.clauses, clause);
      const members = [...row.querySelectorAll("[data-verdict]")];
      let any = false;
      for (const cell of members) {
        const isShown =
          isChosen &&
          verdicts.has(cell.dataset.verdict) &&
          (renderer.value === "" || cell.dataset.renderer === renderer.value) &&
          words.get(cell).includes(wanted);
        cell.classList.toggle("filtered", !isShown);
        any ||= isShown;
        shown += isShown;
      }
      row.classList.toggle("filtered", members.length > 0 && !any);
    }
    const hidden = new Set(rows.filter((row) => row.matches(".filtered")).map((row) => row.dataset.scene));
    for (const section of sections) section.classList.toggle("filtered", hidden.has(section.dataset.scene));
    announcement.textContent =
      shown === cells.length ? "" : say("Showing {shown} of {all} cells.", { shown, all: cells.length });
  }

  for (const box of boxes) {
    box.disabled = false;
    box.addEventListener("change", apply);
  }
  for (const control of [text, renderer, feature, clause]) control?.addEventListener("input", apply);
  document.querySelector(".filters").hidden = false;
  const goTo = (name, target, key) => ({ name, key, run: () => document.querySelector(target)?.focus() });
  const troubles = () => [...document.querySelectorAll("#causes .cells a")];
  const step = (by) => {
    const links = troubles();
    const place = links.indexOf(document.activeElement);
    links[Math.min(Math.max(place + by, 0), links.length - 1)]?.focus();
  };
  addCommands(
    goTo("Filter by text", "#filter-text", "/"),
    goTo("Filter by renderer", "#filter-renderer"),
    goTo("Filter by feature", "#filter-feature"),
    ...(clause ? [goTo("Filter by clause", "#filter-clause")] : []),
    { name: "Next cell that needs a look", key: "n", run: () => step(1) },
    { name: "Previous cell that needs a look", key: "p", run: () => step(-1) },
    { name: "To the matrix", key: "m", run: () => document.querySelector("#matrix .scroll")?.focus() },
  );
  for (const box of boxes) {
    addCommands({ name: say("Show or hide: {verdict}", { verdict: say(box.value) }), run: () => box.click() });
  }
  apply(); // a browser may restore the controls of an earlier visit
}

startOverview();
