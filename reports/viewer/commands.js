"use strict";

// All that can be done, with its key: the keyboard, the palette and the buttons run the same commands.

const commands = [];

// A command is {name, key, run}; `release` is run when the key is let go. `key` is as KeyboardEvent has it.
function addCommands(...added) {
  commands.push(...added);
}

function element(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name.includes("-") || ["role", "for", "list", "translate", "scope"].includes(name))
      made.setAttribute(name, value);
    else made[name] = value;
  }
  made.append(...children);
  return made;
}

const KEY_WORDS = { " ": "Space", ArrowLeft: "←", ArrowRight: "→", ArrowUp: "↑", ArrowDown: "↓" };

function commandButton(command, word = say(command.name)) {
  const button = element("button", { type: "button", title: say(command.name) }, word);
  if (command.key) {
    button.setAttribute("aria-keyshortcuts", command.key === " " ? "Space" : command.key);
    button.append(" ", element("kbd", { "aria-hidden": "true" }, KEY_WORDS[command.key] ?? command.key));
  }
  if (word !== say(command.name)) button.setAttribute("aria-label", say(command.name));
  button.addEventListener("click", () => command.run());
  return button;
}

function makePalette() {
  const input = element("input", {
    type: "search",
    "aria-label": say("Find a command"),
    placeholder: say("Find a command"),
  });
  const list = element("ul");
  const dialog = element("dialog", { className: "palette", "aria-label": say("Commands") }, input, list);
  const buttons = () => [...list.querySelectorAll("button")].filter((button) => !button.parentElement.hidden);

  function fill() {
    list.replaceChildren();
    for (const command of commands.filter(({ release }) => !release)) {
      // nothing can be held here
      const button = commandButton({ ...command, run: () => run(command) });
      list.append(element("li", {}, button));
    }
  }
  function run(command) {
    dialog.close();
    command.run();
  }
  function find() {
    const wanted = input.value.toLowerCase();
    for (const item of list.children) item.hidden = !item.textContent.toLowerCase().includes(wanted);
  }
  input.addEventListener("input", find);
  dialog.addEventListener("keydown", (event) => {
    const shown = buttons();
    const place = shown.indexOf(document.activeElement);
    if (event.key === "ArrowDown") shown[Math.min(place + 1, shown.length - 1)]?.focus();
    else if (event.key === "ArrowUp") (place > 0 ? shown[place - 1] : input).focus();
    else if (event.key === "Enter" && place < 0) shown[0]?.click();
    else return;
    event.preventDefault();
  });
  document.body.append(dialog);
  return () => {
    fill();
    input.value = "";
    dialog.showModal();
    input.focus();
  };
}

const typesText = (target) => target.matches("input:not([type=range], [type=checkbox]), select, textarea");

function listenToKeys(openPalette) {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey && event.key.toLowerCase() === "k") {
      event.preventDefault();
      openPalette();
      return;
    }
    if (event.ctrlKey || event.altKey || event.metaKey || document.querySelector("dialog[open]")) return;
    if (typesText(event.target)) return;
    if (event.key === " " && event.target.matches("button, summary, input")) return; // the key that presses it
    if (event.key.startsWith("Arrow") && event.target.matches("input")) return; // the keys that move a slider
    if (event.repeat && commands.find((command) => command.key === event.key)?.release) return;
    const command = commands.find((known) => known.key === event.key && (known.where?.(event.target) ?? true));
    if (!command) return;
    event.preventDefault();
    command.run(event);
  });
  document.addEventListener("keyup", (event) => {
    commands.find((command) => command.key === event.key)?.release?.();
  });
}

function select(node) {
  const range = document.createRange();
  range.selectNodeContents(node);
  const selection = window.getSelection();
  selection.removeAllRanges();
  selection.addRange(range);
}

async function copy(code, button) {
  try {
    await navigator.clipboard.writeText(code.textContent);
    button.textContent = say("Copied");
  } catch {
    select(code);
    button.textContent = say("Selected: press Ctrl+C");
  }
}

function addCopyButton(code) {
  const button = element("button", { type: "button", "aria-label": say("Copy the command") }, say("Copy"));
  button.addEventListener("click", () => {
    button.removeAttribute("aria-label"); // its text now tells the outcome
    copy(code, button);
  });
  code.closest("[data-copy]").append(button);
}

// The head of each page: the palette and the language.
function addPageTools() {
  const openPalette = makePalette();
  const palette = { name: "Commands", key: "?", run: openPalette };
  const language = { name: chosenLanguage() === "en" ? "中文" : "English", run: switchLanguage };
  addCommands(palette, language);
  const languageButton = commandButton(language);
  languageButton.lang = chosenLanguage() === "en" ? "zh-CN" : "en";
  document
    .querySelector("nav")
    .append(element("span", { className: "page-tools" }, commandButton(palette), languageButton));
  listenToKeys(openPalette);
  for (const code of document.querySelectorAll("[data-copy] code")) addCopyButton(code);
}
