"use strict";

/** Charts of numbers against time, linked: one cursor for all, a line where the player is; a click
    goes there. */
class Charts {
  constructor(section, place, player) {
    this.section = section;
    this.place = place;
    this.player = player;
    this.groups = [];
    this.charts = [];
    look.listeners.push(() => this.build());
    player.listeners.push(() => this.markTime());
    new ResizeObserver(() => this.resize()).observe(place);
  }

  /** Runs as sharedCharts takes them. */
  show(runs) {
    this.groups = sharedCharts(runs);
    this.section.hidden = this.groups.length === 0;
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
    const hours = this.player.end > 7200;
    const axis = {stroke: look.quiet, grid: {stroke: look.line, width: 1},
                  ticks: {stroke: look.line, width: 1}, font: "12px system-ui, sans-serif"};
    const curves = curvesOf(group);
    // Of two runs one may be over early, or have a chart of its own.
    const wholeTime = (chart, least, most) => [Math.min(least, 0), Math.max(most, this.player.end)];
    const lines = curves.map(curve => ({
      label: curve.label, stroke: curve.bound ? "transparent" : [look.accent, look.other][curve.run],
      width: curve.bound ? 0 : 1.6, dash: curve.run > 0 ? [6, 4] : undefined, points: {show: false},
      class: curve.unlisted ? "unlisted" : undefined,
      value: (chart, number, series, k) => legendText(curve, k === null ? null : chart.data[0][k])}));
    const bands = group.parts.flatMap(({run}) => {
      const bound = name => 1 + curves.findIndex(curve => curve.run === run && curve.bound === name);
      return bound("max") > 0 && bound("min") > 0
        ? [{series: [bound("max"), bound("min")], fill: [look.band, look["other-band"]][run]}] : [];
    });
    const options = {
      width: 400, height: 190, bands,
      cursor: {sync: {key: "shoal"}, drag: {x: false, y: false}, points: {size: 5}},
      legend: {live: true,
               markers: {dash: (chart, series) => curves[series - 1]?.run > 0 ? "dashed" : "solid"}},
      scales: {x: {time: false, ...(this.player.maps.length > 1 && {range: wholeTime})},
               y: {range: (chart, least, most) => niceRange(least, most)}},
      axes: [{...axis, values: (chart, ticks) => ticks.map(t => hours ? numberText(t / 3600) : t),
              incrs: hours ? [300, 600, 900, 1800, 3600, 7200, 14400, 21600, 43200, 86400]
                           : [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000],
              label: hours ? "Time (h)" : "Time (s)", labelSize: 18, size: 30,
              labelFont: axis.font},
             {...axis, size: 56, values: (chart, ticks) => ticks.map(numberText)}],
      series: [{label: "Time", value: (chart, t) => t === null ? "–" : clockText(t)}, ...lines],
    };
    const chart = new uPlot(options, columnsOf(group), figure);
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
