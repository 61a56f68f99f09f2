"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const byId = id => document.getElementById(id);

function showHead() {
  document.title = `${data.title} – shoal`;
  byId("title").textContent = data.title;
  const trials = data.done + data.failed + data.missing;
  const counted = [[trials, "trial"], [data.tables.length, "table"],
                   [data.claims.statements.length, "statement"]];
  byId("facts").textContent = counted.filter(([count]) => count > 0)
    .map(([count, noun]) => `${count} ${noun}${count === 1 ? "" : "s"}`).join(" · ");
  const note = text => byId("notes").append(element("p", {}, text));
  if (data.failed) note(`${data.failed} trials failed; they are missing from the numbers.`);
  if (data.missing) note(`${data.missing} trials have not run yet; shoal sweep runs them.`);
}

/** A verdict for each column, which is named where there are several. */
function verdictCell(verdicts) {
  const {columns} = data.claims;
  return element("td", {}, ...verdicts.map((verdict, i) => element("div", {},
    ...(columns[i] ? [element("span", {class: "quiet"}, `${columns[i]} `)] : []),
    element("span", {class: `verdict ${verdict.replace(" ", "-")}`}, verdict))));
}

function linesOf(part) {
  const {columns} = data.claims;
  return element("ul", {class: "contrasts"}, ...part.lines.flatMap((lines, i) =>
    lines.map(line => element("li", {}, columns[i] ? `${columns[i]}: ${line}` : line))));
}

function statementRow(statement) {
  const said = element("td", {}, element("div", {}, statement.says));
  if (statement.not_tested) said.append(element("div", {class: "quiet"}, statement.not_tested));
  for (const part of statement.parts) {
    if (statement.parts.length > 1) {
      said.append(element("div", {class: "part"}, `${part.says} (${part.verdicts.join(", ")})`));
    }
    said.append(linesOf(part));
  }
  const number = statement.number ? `${statement.number} ` : "";
  const row = element("tr", {"data-verdicts": statement.verdicts.join("|"), role: "row"},
                      verdictCell(statement.verdicts),
                      element("td", {class: "quiet"}, number + statement.section), said);
  // On a phone a row is a grid, which would be no row of a table to a screen reader.
  for (const cell of row.children) cell.setAttribute("role", "cell");
  return row;
}

function showClaims() {
  const {statements, counts, note} = data.claims;
  byId("claims-section").hidden = statements.length === 0;
  byId("counts").textContent = counts.join("; ");
  byId("claims-note").textContent = note;
  if (!statements.some(each => each.number || each.section)) byId("claims-table").className = "unnumbered";
  for (const kind of ["all", "reproduced", "contradicted", "undecided", "not tested"]) {
    byId("verdicts").append(element("option", {value: kind}, kind));
  }
  for (const statement of statements) byId("claims").append(statementRow(statement));
  byId("verdicts").addEventListener("change", () => {
    const wanted = byId("verdicts").value;
    for (const row of byId("claims").children) {
      row.hidden = wanted !== "all" && !row.dataset.verdicts.split("|").includes(wanted);
    }
  });
}

function showFigures() {
  byId("figures-section").hidden = data.figures.length === 0;
  for (const {name, image} of data.figures) {
    byId("figures").append(element("figure", {class: "picture"},
      element("img", {src: image, alt: `Figure: ${name.replaceAll("_", " ")}`}),
      element("figcaption", {class: "quiet"}, name.replaceAll("_", " "))));
  }
}

const LONG_TABLE = 25;  // rows: longer ones are opened by hand

function showTables() {
  const list = element("ul");
  for (const {name, html, points: columns} of data.tables) {
    const place = element("div", {class: "scroll", tabindex: "0", role: "region",
                                  "aria-label": `Table ${name}`});
    place.innerHTML = html;  // escaped where it was made
    const captioned = place.querySelector("caption");
    const caption = captioned.textContent || name.replaceAll("_", " ");
    captioned.replaceChildren(element("span", {}, caption));
    const rows = place.querySelectorAll("tbody tr").length;
    if (rows > LONG_TABLE) {
      byId("tables").append(element("details", {id: `long:${name}`},
        element("summary", {}, `${caption} (${rows} rows)`), place));
    } else {
      byId("tables").append(place);
    }
    if (columns.length > 0) {
      const shown = columns.reduce((sum, column) => sum + column.rows.length, 0);
      const section = points.section(columns, caption, shown > LONG_TABLE);
      byId("tables").append(section);
      points.link(place.querySelector("table"), section);
    }
    if (data.files.includes(name)) byId("tables").append(filesOf(name));
    const link = element("a", {href: `#tab:${name}`}, caption);
    link.addEventListener("click", () => {
      const long = byId(`long:${name}`);
      if (long) long.open = true;
    });
    list.append(element("li", {}, link));
  }
  if (data.tables.length > 1) {
    byId("contents").append(element("details", {open: ""}, element("summary", {}, "Tables"), list));
  }
}

/** The same table for a paper or another program, beside this page. */
function filesOf(name) {
  const link = ending => element("a", {href: `tables/${name}.${ending}`}, `${name}.${ending}`);
  return element("p", {class: "files"}, "This table as ", link("tex"), ", ", link("csv"), " and ",
                 link("md"));
}

function showFailures() {
  byId("failures-section").hidden = data.failures.length === 0;
  for (const {trial, reason} of data.failures) {
    byId("failures").append(element("li", {}, element("b", {}, trial), `: ${reason}`));
  }
}

function showHistory() {
  byId("program").textContent = data.program ? `shoal ${data.program}` : "no program yet";
  byId("study").textContent = data.study;
  const save = byId("save");
  save.href = URL.createObjectURL(new Blob([data.study], {type: "application/toml"}));
  save.download = "study.toml";
  byId("reproduce").after(copyButton("shoal sweep study.toml"));
  const sweeps = data.manifest?.sweeps ?? [];
  const table = element("table", {}, element("thead", {}, element("tr", {},
    ...["Host", "Processor", "Jobs", "Shard", "Began (UTC)", "Trials", "Failed", "Seconds", "Commit"]
      .map(text => element("th", {scope: "col"}, text)))));
  for (const sweep of sweeps) {
    table.append(element("tr", {}, ...[
      sweep.host?.name, sweep.host?.processor, sweep.jobs, sweep.shard ?? "–", sweep.began,
      sweep.trials_run ?? "–", sweep.failed ?? "–", sweep.wall_s?.toFixed(1) ?? "–",
      `${sweep.program?.commit ?? "–"}${sweep.program?.dirty ? " and changes" : ""}`]
      .map(text => element("td", {}, String(text ?? "–")))));
  }
  byId("history").append(element("div", {class: "scroll", tabindex: "0", role: "region",
                                         "aria-label": "Sweeps"}, table));
}

look.start();
showHead();
showClaims();
showFigures();
showTables();
showFailures();
showHistory();
