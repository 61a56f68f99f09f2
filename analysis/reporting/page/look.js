"use strict";

/** Light or dark, as the reader's system says or as the button was pressed. */
const look = {
  name: "light",
  listeners: [],

  read() {
    const style = getComputedStyle(document.documentElement);
    this.name = style.getPropertyValue("--name").trim();
    for (const colour of ["paper", "ink", "quiet", "line", "ground", "accent", "current", "band",
                          "other", "other-band"]) {
      this[colour] = style.getPropertyValue(`--${colour}`).trim();
    }
  },

  changed() {
    this.read();
    for (const listener of this.listeners) listener();
  },

  start() {
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.changed());
    document.getElementById("look").addEventListener("click", () => {
      document.documentElement.dataset.look = this.name === "dark" ? "light" : "dark";
      this.changed();
    });
    this.read();
  },
};

/** A new element with its attributes and what is in it (elements, or text). */
function element(kind, attributes = {}, ...content) {
  const made = document.createElement(kind);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...content);
  return made;
}

/** Four digits that count. */
function numberText(number) {
  if (number === null || number === undefined || Number.isNaN(number)) return "–";
  if (number !== 0 && (Math.abs(number) >= 1e6 || Math.abs(number) < 1e-4)) {
    return number.toExponential(3);
  }
  return String(Number(number.toPrecision(4)));
}

/** 1:02:03 */
function clockText(seconds) {
  const whole = Math.floor(seconds + 1e-6);
  const two = number => String(number).padStart(2, "0");
  return `${Math.floor(whole / 3600)}:${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}`;
}

/** A button that copies a text. */
function copyButton(text) {
  const button = element("button", {type: "button", class: "copy"}, "Copy");
  button.addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(text);
      button.textContent = "Copied";
    } catch {
      button.textContent = "Select it and copy";  // browsers forbid it to some pages
    }
    setTimeout(() => { button.textContent = "Copy"; }, 2000);
  });
  return button;
}
