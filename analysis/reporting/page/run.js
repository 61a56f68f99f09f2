"use strict";

const data = JSON.parse(document.getElementById("data").textContent);
const byId = id => document.getElementById(id);

function wirePlayback(player) {
  const {trial} = player;
  const scrub = byId("scrub");
  scrub.step = "any";
  scrub.addEventListener("input", () => player.seek(Number(scrub.value)));
  // "any" leaves the width of a key's step to the browser, which takes a whole second.
  scrub.addEventListener("keydown", event => {
    const by = {ArrowLeft: -1, ArrowRight: 1}[event.key];
    if (!by) return;
    event.preventDefault();
    player.step(by);
  });

  byId("play").addEventListener("click", () => player.playing ? player.pause() : player.play());
  byId("back").addEventListener("click", () => player.step(-1));
  byId("on").addEventListener("click", () => player.step(1));
  byId("closer").addEventListener("click", () => { player.camera.zoom(1.3); player.changed(); });
  byId("farther").addEventListener("click", () => { player.camera.zoom(1 / 1.3); player.changed(); });
  byId("fit").addEventListener("click", () => player.fit());

  const speed = byId("speed");
  const speeds = [1, 5, 10, 30, 60, 120, 300, 600, 1200, 3600];
  for (const times of speeds) speed.append(element("option", {value: times}, `${times}×`));
  player.speed = speeds.find(times => trial.end / times <= 60) ?? 3600;  // a minute, or less
  speed.value = player.speed;
  speed.addEventListener("change", () => { player.speed = Number(speed.value); });

  const trail = byId("trail");
  for (const [label, seconds] of [["whole", Infinity], ["1 h", 3600], ["10 min", 600], ["1 min", 60]]) {
    if (seconds === Infinity || seconds < trial.end) {
      trail.append(element("option", {value: seconds}, label));
    }
  }
  trail.addEventListener("change", () => {
    player.trailSeconds = Number(trail.value);
    player.changed();
  });

  showChoices(player);
  const vehicle = byId("vehicle");
  vehicle.addEventListener("change", () => player.select(Number(vehicle.value)));

  let spokenAt = null;
  player.listeners.push(() => {
    scrub.max = player.end;
    scrub.value = player.time;
    scrub.setAttribute("aria-valuetext", clockText(player.time));
    byId("clock").textContent = `${clockText(player.time)} / ${clockText(player.end)}`;
    byId("play").textContent = player.playing ? "Pause" : "Play";
    vehicle.value = player.selected;
    byId("crowd").hidden = !player.crowded();
    const states = player.maps.map(map => map.seen(player));
    byId("hint").hidden = player.selected >= 0;
    showNumbers(byId("numbers"), states[0]);
    // Spoken when it rests: a voice at every frame cannot be followed.
    const labels = player.maps.map(({label}) => label && `${capital(label)}: `);
    const at = [player.time, player.selected, ...labels].join();
    if (!player.playing && at !== spokenAt) {
      spokenAt = at;
      const texts = states.map((state, r) => labels[r] + stateText(state));
      byId("said").textContent = texts.join(" ");
      player.maps.forEach(({canvas}, r) => {
        canvas.setAttribute("aria-label", `Map of the swarm. ${texts[r]}`);
      });
    }
  });
}

/** The layers and vehicles that there are to choose from. */
function showChoices(player) {
  byId("layers").replaceChildren(element("legend", {}, "Shown"));
  for (const layer of player.layers()) {
    const box = element("input", {type: "checkbox", id: `layer-${layer.name}`});
    box.checked = player.shown.has(layer.name);
    box.addEventListener("change", () => player.show(layer.name, box.checked));
    byId("layers").append(element("label", {}, box, layer.label));
  }
  byId("vehicle").replaceChildren(
    element("option", {value: -1}, "none"),
    ...player.names.map((name, i) => element("option", {value: i}, name)));
}

function stateText({trial, time, over, selected}) {
  const left = trial.names.map((name, i) => i).filter(i => !trial.lost(i, time));
  const thrusting = left.filter(i => trial.mode(i, time).thrusting).length;
  const of = selected < 0 ? "" : ` Vehicle ${trial.names[selected]} is selected.`;
  const lost = trial.size - left.length;
  return `${over ? "Ended at" : "At"} ${clockText(time)}, ${thrusting} of ${left.length} vehicles thrust`
         + `${lost ? `, ${lost} are lost` : ""}.${of}`;
}

/** The numbers of the selected vehicle. */
function showNumbers(list, {trial, time, selected}) {
  list.replaceChildren();
  if (selected < 0) return;
  const row = (term, text) => list.append(element("dt", {}, term), element("dd", {}, text));
  if (trial.lost(selected, time)) {
    row("State", `lost after ${clockText(trial.lastSeen(selected).time)}`);
    return;
  }
  const value = name => trial.value(name, selected, time);
  const {thrusting, reason} = trial.mode(selected, time);
  const [x, y] = trial.position(selected, time);
  row("State", thrusting ? "thrusts" : "drifts");
  row("East, north", `${x.toFixed(1)} m, ${y.toFixed(1)} m`);
  row("Heading", `${trial.heading(selected, time).toFixed(0)}°`);
  row("Speed", `${value("speed").toFixed(2)} m/s`);
  row("Target", reason === "placed"
    ? `${Math.hypot(value("target_x"), value("target_y")).toFixed(1)} m away`
    : `holds: ${reason.replaceAll("_", " ")}`);
  row("Energy", `${numberText(value("energy"))} Wh`);
  row("Distance", `${value("distance").toFixed(0)} m`);
  row("Thrusting so far", time > 0 ? `${(100 * value("thrust_time") / time).toFixed(1)} %` : "–");
  row("In range", String(inRange(trial, selected, time).length));
}

function showScenario() {
  byId("scenario").textContent = data.scenario;
  const save = byId("save");
  save.href = URL.createObjectURL(new Blob([data.scenario], {type: "application/toml"}));
  save.download = "scenario.toml";
  byId("reproduce").textContent = "shoal run scenario.toml";
  byId("reproduce").after(copyButton("shoal run scenario.toml"));
  byId("program").textContent = `shoal ${data.program}`;
}

function showHead() {
  document.title = `${data.title} – shoal`;
  byId("title").textContent = data.title;
  const facts = [data.behaviour.replaceAll("_", " "), `${data.vehicles.length} vehicles`,
                 clockText(data.end_s), `seed ${data.seed}`];
  byId("facts").textContent = facts.join(" · ");
  byId("notes").append(...data.notes.map(note => element("p", {}, note)));
}

function start() {
  look.start();
  showHead();
  showMeasures([data]);
  showScenario();
  for (const {text, does} of KEYS.filter(key => key.text)) {
    byId("keys").append(element("dt", {}, element("kbd", {}, text)), element("dd", {}, does));
  }
  if (!data.tracks) {
    byId("playback").hidden = byId("curves").hidden = true;
    return;
  }
  const trial = new Trial(data);
  const player = new Player(trial, byId("map"));
  wirePlayback(player);
  takeGestures(player, player.maps[0]);
  takeKeys(player);
  look.listeners.push(() => player.changed());
  new ResizeObserver(() => player.resize()).observe(player.canvas);
  player.resize();
  const groups = chartGroups(data.series);
  const charts = new Charts(byId("curves"), byId("charts"), player);
  charts.show([{label: "", groups}]);
  const beside = new Beside(player, charts, {data, groups});
  player.changed();
  window.shoal = {player, trial, charts, beside};
}

start();
