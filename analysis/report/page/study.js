"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const byId = id => document.getElementById(id);

function showHead() {
  document.title = `${data.title} – shoal`;
  byId("title").textContent = data.title;
  const trials = data.done + data.failed + data.missing;
  byId("facts").textContent = [`${trials} trials`, `${data.tables.length} tables`,
                               `${data.claims.length} claims`].join(" · ");
  const note = text => byId("notes").append(element("p", {}, text));
  if (data.failed) note(`${data.failed} trials failed; they are missing from the numbers.`);
  if (data.missing) note(`${data.missing} trials have not run yet; shoal sweep runs them.`);
}

function showClaims() {
  byId("claims-section").hidden = data.claims.length === 0;
  const count = verdict => data.claims.filter(claim => claim.verdict === verdict).length;
  const kinds = ["reproduced", "contradicted", "undecided"];
  byId("counts").textContent = kinds.map(kind => `${count(kind)} ${kind}`).join(", ");
  for (const kind of ["all", ...kinds]) byId("verdicts").append(element("option", {value: kind}, kind));
  for (const claim of data.claims) {
    const said = element("td", {}, element("div", {}, claim.says));
    const numbers = element("ul", {class: "contrasts"},
                            ...claim.contrasts.map(text => element("li", {}, text)));
    if (claim.replications_needed !== null) {
      numbers.append(element("li", {}, `about ${claim.replications_needed} replications would decide`));
    }
    said.append(numbers);
    if (claim.cause) said.append(element("div", {class: "cause"}, `Likely cause: ${claim.cause}`));
    byId("claims").append(element("tr", {"data-verdict": claim.verdict},
      element("td", {}, element("span", {class: `verdict ${claim.verdict}`}, claim.verdict)),
      element("td", {class: "quiet"}, claim.section), said));
  }
  byId("verdicts").addEventListener("change", () => {
    const wanted = byId("verdicts").value;
    for (const row of byId("claims").children) {
      row.hidden = wanted !== "all" && row.dataset.verdict !== wanted;
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
  for (const {name, html} of data.tables) {
    const place = element("div", {class: "scroll", tabindex: "0", role: "region",
                                  "aria-label": `Table ${name}`});
    place.innerHTML = html;  // escaped where it was made
    const rows = place.querySelectorAll("tbody tr").length;
    if (rows > LONG_TABLE) {
      byId("tables").append(element("details", {id: `long:${name}`},
        element("summary", {}, `${place.querySelector("caption").textContent} (${rows} rows)`), place));
    } else {
      byId("tables").append(place);
    }
    const link = element("a", {href: `#tab:${name}`}, name.replaceAll("_", " "));
    link.addEventListener("click", () => {
      const long = byId(`long:${name}`);
      if (long) long.open = true;
    });
    byId("contents").append(link, " ");
  }
}

function showFailures() {
  byId("failures-section").hidden = data.failures.length === 0;
  for (const {trial, reason} of data.failures) {
    byId("failures").append(element("li", {}, element("b", {}, trial), `: ${reason}`));
  }
}

function showHistory() {
  byId("program").textContent = data.program ? `shoal ${data.program}` : "nobody yet";
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
