"use strict";

/** Every trial of a table's cells as a point, beside mean and interval; rows share one scale. */
const points = {
  /** About five round numbers from low to high. */
  ticks(low, high) {
    const rough = (high - low) / 5 || 1;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map(k => k * power).find(each => each >= rough);
    const found = [];
    for (let k = Math.ceil(low / step); k * step <= high + 1e-9 * step; k++) found.push(k * step);
    return found;
  },

  shape(kind, attributes) {
    const made = document.createElementNS("http://www.w3.org/2000/svg", kind);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
    return made;
  },

  /** Points side by side where they would hide one another: at most seven deep. */
  strip(row, place) {
    const svg = this.shape("svg", {class: "strip", role: "img",
      "aria-label": `${row.label}: mean ${numberText(row.value)}, ${row.each.length} trials from `
        + `${numberText(Math.min(...row.each))} to ${numberText(Math.max(...row.each))}`});
    if (row.low !== undefined) {  // below the points, which stay dark on it
      svg.append(this.shape("line", {x1: `${place(row.low)}%`, x2: `${place(row.high)}%`, y1: 13,
                                     y2: 13, class: "interval"}));
    }
    const depth = new Map();
    for (const x of [...row.each].sort((a, b) => a - b)) {
      const bin = Math.round(place(x));
      const k = depth.get(bin) ?? 0;
      depth.set(bin, k + 1);
      const off = (k % 2 ? 1 : -1) * Math.ceil(k / 2) % 4 * 3;
      const dot = this.shape("circle", {cx: `${place(x)}%`, cy: 13 + off, r: 2.5, class: "trial"});
      const title = this.shape("title", {});
      title.textContent = numberText(x);
      dot.append(title);
      svg.append(dot);
    }
    svg.append(this.shape("line", {x1: `${place(row.value)}%`, x2: `${place(row.value)}%`, y1: 5,
                                   y2: 21, class: "mean"}));
    return svg;
  },

  /** One column of a table. */
  chart({title, unit, rows}) {
    const all = rows.flatMap(row => [...row.each, row.low ?? row.value, row.high ?? row.value]);
    const least = all.reduce((a, b) => Math.min(a, b)), most = all.reduce((a, b) => Math.max(a, b));
    const wide = most - least || Math.abs(most) || 1;
    const from = most > least ? least : least - wide / 2;  // what is all the same is in the middle
    const place = x => 2 + 96 * (x - from) / wide;  // percent of the strip
    const scale = element("div", {class: "scale"});
    for (const tick of this.ticks(from, from + wide)) {
      scale.append(element("span", {style: `left: ${place(tick)}%`}, numberText(tick)));
    }
    return element("figure", {class: "points"},
      element("figcaption", {}, title + (unit ? ` (${unit})` : "")),
      ...rows.map(row => {
        const made = element("div", {class: "points-row"},
          element("div", {class: "points-label"}, row.label), this.strip(row, place));
        made.dataset.cell = row.cell.join();
        return made;
      }),
      element("div", {class: "points-row", "aria-hidden": "true"}, element("div"), scale));
  },

  /** All of a table, to be opened by hand where they are many. */
  section(columns, caption, long) {
    const section = element("details", {class: "trials"},
      element("summary", {}, `Every trial: ${caption}`),
      element("p", {class: "quiet"}, "A point is a trial; the bar is the mean, with its interval."),
      ...columns.map(column => this.chart(column)));
    section.open = !long;
    return section;
  },

  /** A cell of the table leads to its trials. */
  link(table, section) {
    const rows = table.querySelectorAll("tbody tr");
    for (const target of section.querySelectorAll("[data-cell]")) {
      const [row, column] = target.dataset.cell.split(",").map(Number);
      const cell = rows[row].children[column];
      const button = element("button", {type: "button", class: "to-trials", title: "its trials"});
      button.append(...cell.childNodes);
      cell.append(button);
      button.addEventListener("click", () => {
        section.open = true;
        section.querySelector(".pointed")?.classList.remove("pointed");
        target.classList.add("pointed");
        target.scrollIntoView({block: "center"});
      });
    }
  },
};
