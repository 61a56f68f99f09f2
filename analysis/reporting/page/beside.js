"use strict";

/** Opens another run beside the page's own, with one clock, and closes it again. `mine` is the page's
    {data, groups}. */
class Beside {
  constructor(player, charts, mine) {
    this.player = player;
    this.charts = charts;
    this.mine = mine;
    this.other = null;
    this.made = [];  // elements of the page that go when the other run is closed
    this.refused = document.getElementById("refused");
    this.button = document.getElementById("beside");
    this.takeFiles();
    player.listeners.push(() => this.showState());
  }

  takeFiles() {
    const input = document.getElementById("other-file");
    this.button.hidden = false;
    this.button.addEventListener("click", () => input.click());
    input.addEventListener("change", async () => {
      const [file] = input.files;
      if (file) await this.read(file);
      input.value = "";  // so that the same file can be chosen again
    });
    // Browsers would leave this page for a file that is dropped on it.
    document.addEventListener("dragover", event => {
      if (event.dataTransfer.types.includes("Files")) event.preventDefault();
    });
    document.addEventListener("drop", event => {
      const [file] = event.dataTransfer.files;
      if (!file) return;
      event.preventDefault();
      this.read(file);
    });
  }

  async read(file) {
    let found;
    try {
      found = otherRun(file.name, await file.text(), this.mine.data);
    } catch {
      found = {problem: `${file.name} cannot be read.`};
    }
    this.refused.hidden = !found.problem;
    this.refused.textContent = found.problem ?? "";
    if (!found.problem) this.open(found);
  }

  open(other) {
    if (this.other) this.close();
    const {player, mine} = this;
    const {x, y, scale} = player.camera;
    this.before = {x, y, scale};
    this.other = other;
    const labels = runLabels(mine.data, other.data);
    const map = this.addMap();
    player.maps.push(map);
    player.maps.forEach((each, r) => { each.label = labels[r]; });
    takeGestures(player, map);
    this.addNumbers(labels);
    document.body.classList.add("two-runs");
    showChoices(player);
    player.resize();
    player.fitCamera();
    showMeasures([mine.data, other.data], labels);
    this.charts.show([mine, other].map(({groups}, r) => ({label: labels[r], groups})));
    player.changed();
  }

  close() {
    const {player, mine} = this;
    player.maps.pop();
    player.maps[0].label = "";
    this.other = null;
    for (const each of this.made) each.remove();
    this.made = [];
    document.body.classList.remove("two-runs");
    showChoices(player);
    player.resize();
    Object.assign(player.camera, this.before);
    if (player.selected >= player.names.length) player.selected = -1;
    showMeasures([mine.data]);
    this.charts.show([{label: "", groups: mine.groups}]);
    player.seek(player.time);  // which may be after the end of this run
  }

  /** The map of the other run, below or beside the first, both with a line that names them. */
  addMap() {
    const canvas = element("canvas", {id: "other-map", tabindex: "0", role: "img",
                                      "aria-label": "Map of the other swarm"});
    const close = element("button", {type: "button", id: "close-other",
                                     "aria-label": "Close the other run"}, "Close");
    close.addEventListener("click", () => {
      this.close();
      this.button.focus();
    });
    const view = element("div", {class: "view"}, canvas);
    const mine = this.player.canvas.parentElement;
    this.ends = [mine, view].map(() => element("p", {class: "end", hidden: ""}));
    mine.append(this.ends[0]);
    view.append(this.ends[1]);
    const captions = [caption(this.mine.data, 0), caption(this.other.data, 1, close)];
    mine.before(captions[0]);
    mine.after(captions[1], view);
    this.made.push(...captions, view, ...this.ends);
    return new TrialMap(this.other.trial, canvas, this.player.camera);
  }

  /** The selected vehicle's numbers, in both runs. */
  addNumbers(labels) {
    this.headings = labels.map((label, r) => element("h4", {hidden: ""}, runMark(r), capital(label)));
    this.numbers = element("dl", {id: "other-numbers"});
    const mine = document.getElementById("numbers");
    mine.before(this.headings[0]);
    mine.after(this.headings[1], this.numbers);
    this.made.push(...this.headings, this.numbers);
  }

  showState() {
    if (!this.other) return;
    const {player} = this;
    player.maps.forEach((map, r) => {
      const {trial, over, selected} = map.seen(player);
      this.ends[r].hidden = !over;
      this.ends[r].textContent = `Ended at ${clockText(trial.end)}`;
      this.headings[r].hidden = selected < 0;
    });
    showNumbers(this.numbers, player.maps[1].seen(player));
  }
}

/** What tells two runs apart, in as few words as do. */
function runLabels(mine, other) {
  const words = [data => data.behaviour.replaceAll("_", " "), data => data.title,
                 data => `seed ${data.seed}`];
  const differs = words.find(each => each(mine) !== each(other));
  return differs ? [differs(mine), differs(other)] : ["this run", "the other run"];
}

/** The line of a run's curves, as a sign of it. */
function runMark(run) {
  return element("span", {class: `mark run-${run}`, "aria-hidden": "true"});
}

function caption(data, run, ...more) {
  return element("div", {class: "caption"}, runMark(run),
                 element("p", {}, element("b", {}, data.title),
                         ` · ${data.behaviour.replaceAll("_", " ")} · seed ${data.seed}`), ...more);
}
