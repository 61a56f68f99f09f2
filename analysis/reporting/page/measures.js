"use strict";

/** Every measure of one run, or of two with a column for each under its label. */
function showMeasures(runs, labels = []) {
  const all = new Map();
  runs.forEach((run, r) => run.measures.forEach(measure => {
    const {name, value} = measure;
    if (!all.has(name)) all.set(name, {...measure, values: runs.map(() => null)});
    all.get(name).values[r] = value;
  }));
  const measures = [...all.values()];
  const held = ({values}) => values.some(value => value !== null);

  const table = document.getElementById("measures");
  table.replaceChildren();
  table.classList.toggle("two", runs.length > 1);
  if (runs.length > 1) table.append(measuresHead(labels));
  for (const {name, values, unit, meaning} of measures.filter(held)) {
    // On a phone a row is a grid, which would be no row of a table to a screen reader.
    const cell = (content, attributes) => element("td", {role: "cell", ...attributes}, content);
    table.append(element("tr", {role: "row"}, element("th", {scope: "row", role: "rowheader"}, name),
                         ...values.map(value => cell(numberText(value), {class: "number"})),
                         cell(unit, {class: "unit"}), cell(meaning, {class: "meaning"})));
  }
  const without = measures.filter(measure => !held(measure)).map(({name}) => name);
  document.getElementById("without").textContent = without.length
    ? `Never, or not of ${runs.length > 1 ? "these trials" : "this trial"}: ${without.join(", ")}.` : "";
}

function measuresHead(labels) {
  const head = (content, kind) => element("th", {scope: "col", role: "columnheader", class: kind},
                                          ...content);
  return element("thead", {role: "rowgroup"}, element("tr", {role: "row"},
    head(["Measure"], "name"), ...labels.map((label, r) => head([runMark(r), label], "number")),
    head(["Unit"], "unit"), head(["Meaning"], "meaning")));
}
