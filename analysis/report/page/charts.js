"use strict";

/** Charts of numbers against time, linked: one cursor for all, a line where the player is; a click
    goes there. */
class Charts {
  constructor(place, data, player) {
    this.place = place;
    this.player = player;
    this.groups = chartGroups(data.series);
    this.charts = [];
    look.listeners.push(() => this.build());
    player.listeners.push(() => this.markTime());
    new ResizeObserver(() => this.resize()).observe(place);
    this.build();
  }

  resize() {
    const columns = getComputedStyle(this.place).gridTemplateColumns.split(" ");
    for (const chart of this.charts) {
      chart.setSize({width: Math.floor(parseFloat(columns[0])), height: 190});
    }
    this.markTime();
  }

  build() {
    this.place.replaceChildren();
    this.charts = this.groups.map(group => this.chart(group));
    this.resize();
  }

  chart(group) {
    const figure = element("figure", {class: "chart"},
                           element("figcaption", {}, element("b", {}, group.title),
                                   element("span", {class: "unit"}, group.unit && ` (${group.unit})`),
                                   element("span", {class: "spoken"}, spoken(group))));
    this.place.append(figure);
    const hours = this.player.trial.end > 7200;
    const axis = {stroke: look.quiet, grid: {stroke: look.line, width: 1},
                  ticks: {stroke: look.line, width: 1}, font: "12px system-ui, sans-serif"};
    const lines = group.lines.map((line, i) => ({
      label: line.label, stroke: line.bound ? "transparent" : [look.accent, look.ink][i % 2],
      width: line.bound ? 0 : 1.6, points: {show: false},
      value: (chart, number) => numberText(number)}));
    const bound = name => 1 + group.lines.findIndex(line => line.bound === name);
    const bands = bound("max") > 0 && bound("min") > 0
      ? [{series: [bound("max"), bound("min")], fill: look.band}] : [];
    const options = {
      width: 400, height: 190, bands,
      cursor: {sync: {key: "shoal"}, drag: {x: false, y: false}, points: {size: 5}},
      legend: {live: true},
      scales: {x: {time: false}, y: {range: (chart, least, most) => niceRange(least, most)}},
      axes: [{...axis, values: (chart, ticks) => ticks.map(t => hours ? numberText(t / 3600) : t),
              incrs: hours ? [300, 600, 900, 1800, 3600, 7200, 14400, 21600, 43200, 86400]
                           : [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000],
              label: hours ? "Time (h)" : "Time (s)", labelSize: 18, size: 30,
              labelFont: axis.font},
             {...axis, size: 56, values: (chart, ticks) => ticks.map(numberText)}],
      series: [{label: "Time", value: (chart, t) => t === null ? "–" : clockText(t)}, ...lines],
    };
    const chart = new uPlot(options, [group.time, ...group.lines.map(line => line.values)], figure);
    chart.now = element("div", {class: "now"});
    chart.over.append(chart.now);
    chart.over.addEventListener("click", () => {
      if (chart.cursor.left >= 0) this.player.seek(chart.posToVal(chart.cursor.left, "x"));
    });
    return chart;
  }

  markTime() {
    for (const chart of this.charts) {
      chart.now.style.left = `${chart.valToPos(this.player.time, "x")}px`;
      const pointedAt = chart.cursor.left >= 0;
      if (!pointedAt) chart.setLegend({idx: lastAtOrBefore(chart.data[0], this.player.time)}, false);
    }
  }
}

/** From zero where that costs little of the height. */
function niceRange(least, most) {
  if (least === null || most === null) return [0, 1];
  const low = least >= 0 && (least < 0.6 * most || least === most) ? 0 : least;
  const margin = 0.05 * (most - low) || 0.5;
  return [low === 0 ? 0 : low - margin, most + margin];
}

// What people ask for first; the others follow in their own order.
const FIRST_CHARTS = ["energy_mean_wh", "quality", "thrust_time_ratio_mean", "thrust_distance_ratio_mean"];

/** Series that belong into one chart: a mean with its least and greatest, else one alone. */
function chartGroups(unsorted) {
  const place = each => FIRST_CHARTS.includes(each.name) ? FIRST_CHARTS.indexOf(each.name)
                                                         : FIRST_CHARTS.length;
  const series = [...unsorted].sort((a, b) => place(a) - place(b));
  const named = new Map(series.map(each => [each.name, each]));
  const groups = [];
  for (const each of series) {
    const alone = {title: capital(each.meaning), unit: each.unit === "1" ? "" : each.unit,
                   time: unpackFloats(each.time_s),
                   lines: [{label: "Value", values: unpackFloats(each.values)}]};
    const [stem, of, unit] = each.name.split(/_(mean|min|max)(?=_|$)/);
    const other = bound => named.get(`${stem}_${bound}${unit ?? ""}`);
    if (of === undefined || !other("mean") || !other("min") || !other("max")) {
      groups.push(alone);
    } else if (of === "mean") {
      alone.lines[0].label = "Mean";
      for (const bound of ["min", "max"]) {
        alone.lines.push({label: bound === "min" ? "Least" : "Greatest", bound,
                          values: unpackFloats(other(bound).values)});
      }
      groups.push(alone);
    }
  }
  return groups;
}

function capital(text) { return text.charAt(0).toUpperCase() + text.slice(1); }

/** What a chart shows, for those who do not see it. */
function spoken({time, lines}) {
  const values = lines[0].values;
  const last = values.length - 1;
  return `: ${numberText(values[0])} at ${clockText(time[0])}, ${numberText(values[last])} at `
         + `${clockText(time[last])}, between ${numberText(Math.min(...values))} and `
         + `${numberText(Math.max(...values))}`;
}
