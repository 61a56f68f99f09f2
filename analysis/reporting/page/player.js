"use strict";

/** Plays a trial, or two side by side: one time, one camera, and the vehicle that is looked at. */
class Player {
  constructor(trial, canvas) {
    this.camera = new Camera();
    this.maps = [new TrialMap(trial, canvas, this.camera)];
    this.time = 0;
    this.playing = false;
    this.speed = 60;  // seconds of the trial in one of ours
    this.selected = -1;
    this.trailSeconds = Infinity;
    this.shown = new Set(LAYERS.filter(layer => layer.shown).map(layer => layer.name));
    this.listeners = [];
    this.frameAsked = false;
  }

  // Of the page's own run.
  get trial() { return this.maps[0].trial; }
  get canvas() { return this.maps[0].canvas; }

  get end() { return Math.max(...this.maps.map(map => map.trial.end)); }

  /** Of the vehicles of the larger swarm. */
  get names() {
    return this.maps.map(map => map.trial.names).reduce((a, b) => b.length > a.length ? b : a);
  }

  layers() { return LAYERS.filter(layer => this.maps.some(map => map.has(layer))); }

  seek(time) {
    this.time = Math.min(Math.max(time, 0), this.end);
    this.changed();
  }

  /** To the next instant that was recorded of any trial, or back. */
  step(by) {
    const {time} = this;
    const trials = this.maps.map(map => map.trial);
    this.pause();
    this.seek(by > 0 ? Math.min(...trials.map(trial => trial.instantAfter(time)))
                     : Math.max(...trials.map(trial => trial.instantBefore(time))));
  }

  play() {
    if (this.time >= this.end) this.time = 0;
    this.playing = true;
    this.last = null;
    this.changed();
  }

  pause() {
    this.playing = false;
    this.changed();
  }

  /** Time goes on by so many milliseconds of ours. Tests call it; else the frames of the screen do. */
  advance(milliseconds) {
    if (!this.playing) return;
    this.time = Math.min(this.time + this.speed * milliseconds / 1000, this.end);
    if (this.time === this.end) this.playing = false;
    this.changed();
  }

  crowded() { return this.maps.some(map => map.crowded(this)); }

  select(vehicle) {
    this.selected = vehicle;
    this.changed();
  }

  show(layer, on) {
    if (on) this.shown.add(layer);
    else this.shown.delete(layer);
    this.changed();
  }

  fit() {
    this.fitCamera();
    this.changed();
  }

  fitCamera() { this.camera.fit(aroundAll(this.maps.map(map => map.trial.bounds()))); }

  /** The page lays maps out in one size. */
  resize() {
    const first = this.camera.width === 1;
    const [{width, height}] = this.maps.map(map => map.resize());
    this.camera.width = width;
    this.camera.height = height;
    if (first) this.fitCamera();
    this.draw();
  }

  changed() {
    for (const listener of this.listeners) listener(this);
    this.askForFrame();
  }

  askForFrame() {
    if (this.frameAsked) return;
    this.frameAsked = true;
    requestAnimationFrame(now => {
      this.frameAsked = false;
      if (this.playing && !this.heldByHand) {
        if (this.last !== null) this.advance(Math.min(now - this.last, 250));
        this.last = now;
        this.askForFrame();
      }
      this.draw();
    });
  }

  draw() {
    for (const map of this.maps) map.draw(this);
  }
}
