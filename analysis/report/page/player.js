"use strict";

/** Plays a trial on a canvas: time, camera, and the vehicle that is looked at. */
class Player {
  constructor(trial, canvas) {
    this.trial = trial;
    this.canvas = canvas;
    this.camera = new Camera();
    this.trails = new Trails();
    this.time = 0;
    this.playing = false;
    this.speed = 60;  // seconds of the trial in one of ours
    this.selected = -1;
    this.trailSeconds = Infinity;
    this.shown = new Set(this.layers().filter(layer => layer.shown).map(layer => layer.name));
    this.listeners = [];
    this.frameAsked = false;
  }

  layers() { return LAYERS.filter(layer => !layer.of || layer.of(this.trial)); }

  seek(time) {
    this.time = Math.min(Math.max(time, 0), this.trial.end);
    this.changed();
  }

  /** To the next recorded instant, or back. */
  step(by) {
    const k = this.trial.instant(this.time);
    const between = this.time > this.trial.time[k];
    const to = by > 0 ? k + 1 : between ? k : k - 1;
    this.pause();
    this.seek(this.trial.time[Math.min(Math.max(to, 0), this.trial.time.length - 1)]);
  }

  play() {
    if (this.time >= this.trial.end) this.time = 0;
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
    this.time = Math.min(this.time + this.speed * milliseconds / 1000, this.trial.end);
    if (this.time === this.trial.end) this.playing = false;
    this.changed();
  }

  /** Whether marks hide one another: a third of the vehicles share a square of their size. */
  crowded() {
    const squares = new Map();
    let left = 0;
    for (let i = 0; i < this.trial.size; ++i) {
      if (this.trial.lost(i, this.time)) continue;
      const place = this.camera.toScreen(...this.trial.position(i, this.time));
      const square = place.map(pixel => Math.floor(pixel / VEHICLE_PIXELS)).join();
      squares.set(square, (squares.get(square) ?? 0) + 1);
      left += 1;
    }
    const sharing = [...squares.values()].reduce((sum, n) => sum + (n > 1 ? n : 0), 0);
    return sharing > 1 && sharing >= left / 3;
  }

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
    this.camera.fit(this.trial.bounds());
    this.changed();
  }

  /** The canvas has its size from the page. */
  resize() {
    const {width, height} = this.canvas.getBoundingClientRect();
    const first = this.camera.width === 1;
    this.camera.width = width;
    this.camera.height = height;
    this.ratio = window.devicePixelRatio || 1;
    this.canvas.width = Math.round(width * this.ratio);
    this.canvas.height = Math.round(height * this.ratio);
    if (first) this.camera.fit(this.trial.bounds());
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
    const ctx = this.canvas.getContext("2d");
    ctx.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    ctx.fillStyle = look.paper;
    ctx.fillRect(0, 0, this.camera.width, this.camera.height);
    const scene = {trial: this.trial, camera: this.camera, time: this.time, look,
                   selected: this.selected, trailSeconds: this.trailSeconds};
    for (const layer of this.layers()) {
      if (!this.shown.has(layer.name)) continue;
      if (layer.name === "trails") this.trails.draw(ctx, scene, this.ratio);
      else layer.draw(ctx, scene);
    }
    drawScale(ctx, scene);
    if (this.shown.has("current") && this.trial.current) drawCurrentScale(ctx, scene);
  }

  /** The vehicle nearest to a pixel, or -1 if none is near. */
  vehicleAt(px, py) {
    let nearest = -1;
    let least = 20;  // pixels
    for (let i = 0; i < this.trial.size; ++i) {
      const [x, y] = this.camera.toScreen(...this.trial.position(i, this.time));
      const away = Math.hypot(x - px, y - py);
      if (away < least) [nearest, least] = [i, away];
    }
    return nearest;
  }
}
