"use strict";

// What people ask for first; the others follow in their own order.
const FIRST_CHARTS = ["energy_mean_wh", "quality", "thrust_time_ratio_mean", "thrust_distance_ratio_mean"];

/** Series of a run that belong into one chart: a mean with its least and greatest, else one alone. */
function chartGroups(unsorted) {
  const place = each => FIRST_CHARTS.includes(each.name) ? FIRST_CHARTS.indexOf(each.name)
                                                         : FIRST_CHARTS.length;
  const series = [...unsorted].sort((a, b) => place(a) - place(b));
  const named = new Map(series.map(each => [each.name, each]));
  const groups = [];
  for (const each of series) {
    const alone = {name: each.name, title: capital(each.meaning),
                   unit: each.unit === "1" ? "" : each.unit, time: unpackFloats(each.time_s),
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

/** The charts of runs ({label, groups}; one, or two): each holds its `parts`, one of every run that has
    it. */
function sharedCharts(runs) {
  const charts = new Map();
  runs.forEach(({label, groups}, run) => {
    for (const {name, title, unit, time, lines} of groups) {
      if (!charts.has(name)) charts.set(name, {title, unit, parts: []});
      charts.get(name).parts.push({run, label, time, lines});
    }
  });
  return [...charts.values()];
}

/** The curves of a chart, named for its legend. That of two runs has a line for each: its bounds stand
    behind the mean as a `range`. */
function curvesOf({parts}) {
  return parts.flatMap(({run, label, time, lines}) => lines.map(line => ({
    ...line, run, time, label: label ? capital(label) : line.label, unlisted: label && line.bound,
    range: label && !line.bound ? lines.filter(each => each.bound).map(each => ({...each, time})) : []})));
}

/** What a legend says of a curve at a time. */
function legendText(curve, at) {
  const text = each => numberText(at === null ? null : valueAt(each, at));
  return text(curve) + (curve.range.length ? ` (${curve.range.map(text).join(" to ")})` : "");
}

/** Times, and a column for each curve. Runs were recorded at instants of their own: where a curve has
    none of them it holds `undefined`, which is drawn across. */
function columnsOf({parts}) {
  const tables = parts.map(({time, lines}) => [time, ...lines.map(line => line.values)]);
  return tables.length === 1 ? tables[0] : uPlot.join(tables);
}

/** A curve's number at a time, the last before it; null after its end. */
function valueAt({time, values}, at) {
  return at > time[time.length - 1] ? null : values[lastAtOrBefore(time, at)];
}

function capital(text) { return text.charAt(0).toUpperCase() + text.slice(1); }

/** What a chart shows, for screen readers. */
function spoken({parts}) {
  return `: ${parts.map(({label, time, lines: [{values}]}) => {
    const last = values.length - 1;
    return `${label && `${label}, `}${numberText(values[0])} at ${clockText(time[0])}, `
           + `${numberText(values[last])} at ${clockText(time[last])}, between `
           + `${numberText(Math.min(...values))} and ${numberText(Math.max(...values))}`;
  }).join("; ")}`;
}
