"use strict";

// Pages are written in English. Another language is a catalogue from English sentences, with places such as {count} for
// what differs from one to the next. Words of scenes, renderers and files are marked by translate="no" and stay.

const catalogues = {};
const LANGUAGE_KEY = "raytruth-language";
const PLACE = /\{(\w+)\}/g;

function addMessages(language, messages) {
  catalogues[language] = messages;
}

function keptLanguage() {
  try {
    return localStorage.getItem(LANGUAGE_KEY);
  } catch {
    return null; // a browser may keep nothing for pages of files
  }
}

function chosenLanguage() {
  const language = keptLanguage() ?? navigator.language;
  return language.startsWith("zh") ? "zh-CN" : "en";
}

const filledIn = (template, values) => template.replace(PLACE, (_, name) => values[name] ?? "");

// A sentence in the reader's language.
function say(template, values = {}) {
  return filledIn(catalogues[chosenLanguage()]?.[template] ?? template, values);
}

const escaped = (text) => text.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");

// Of a sentence with places: what finds them in a text.
function patternOf(template) {
  const parts = template.split(PLACE);
  const pattern = parts.map((part, i) => (i % 2 ? `(?<${part}>.+?)` : escaped(part))).join("");
  return new RegExp(`^${pattern}$`, "su");
}

// Items of a sentence such as `1 failed, 2 are as declared, not as due and 3 ended in an error`.
const BETWEEN_ITEMS = /, (?=\d)| and (?=\d)/;

function makeTranslator(messages) {
  const patterns = Object.keys(messages)
    .filter((template) => template.includes("{"))
    .map((template) => [patternOf(template), messages[template]]);

  function translated(sentence) {
    if (Object.hasOwn(messages, sentence)) return messages[sentence];
    for (const [pattern, translation] of patterns) {
      const match = pattern.exec(sentence);
      if (!match) continue;
      const parts = { ...match.groups };
      for (const name of Object.keys(parts)) {
        const items = name === "list" ? parts[name].split(BETWEEN_ITEMS) : [parts[name]];
        parts[name] = items.map(translated).join("、");
      }
      return filledIn(translation, parts);
    }
    return sentence; // words that no catalogue knows stay as they are
  }
  return (text) => {
    const sentence = text.trim().replace(/\s+/g, " ");
    return text.replace(text.trim(), () => translated(sentence));
  };
}

function translatePage() {
  const language = chosenLanguage();
  if (language === "en") return;
  document.documentElement.lang = language;
  const translated = makeTranslator(catalogues[language]);
  const isOurs = (node) => !(node.parentElement ?? node).closest("[translate=no], script, style, code");
  const texts = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const node = texts.currentNode;
    if (node.data.trim() && isOurs(node)) node.data = translated(node.data);
  }
  for (const element of document.querySelectorAll("[title], [aria-label]")) {
    if (!isOurs(element)) continue;
    for (const name of ["title", "aria-label"]) {
      if (element.hasAttribute(name)) element.setAttribute(name, translated(element.getAttribute(name)));
    }
  }
}

function switchLanguage() {
  const next = chosenLanguage() === "en" ? "zh-CN" : "en";
  try {
    localStorage.setItem(LANGUAGE_KEY, next);
  } catch {
    return;
  }
  location.reload(); // the page is written in English: what is shown is made anew from it
}
