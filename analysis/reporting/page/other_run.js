"use strict";

/** The run in the text of a report: {data, trial, groups} of its charts, or {problem}, a sentence, where
    it has none that can be played beside `mine`, the data of this page. */
function otherRun(name, text, mine) {
  const script = new DOMParser().parseFromString(text, "text/html")
    .querySelector('script#data[type="application/json"]');
  const data = script && parsed(script.textContent);
  if (!data?.measures && !data?.claims) return {problem: `${name} is no report of shoal.`};
  if (data.claims) {
    return {problem: `${name} is the report of a study: only the report of a run can be played.`};
  }
  if (Array.isArray(data.vehicles) && !data.tracks) {
    return {problem: `${name} has nothing to play: its run was not recorded.`};
  }
  // A field that is new since then has nothing to stand for it.
  const lacks = Object.keys(mine).some(field => !(field in data));
  const read = lacks ? null : unpacked(data);
  return read ? {data, ...read}
              : {problem: `${name} is of an older form, or damaged: shoal report FOLDER writes it again.`};
}

function parsed(json) {
  try {
    return JSON.parse(json);
  } catch {
    return null;
  }
}

function unpacked(data) {
  try {
    const trial = new Trial(data);
    const whole = Object.values(trial.columns)
      .every(column => column.length === trial.size * trial.time.length);
    if (!whole || trial.time.length === 0 || !Array.isArray(data.measures)) return null;
    trial.bounds();
    return {trial, groups: chartGroups(data.series)};
  } catch {
    return null;
  }
}
