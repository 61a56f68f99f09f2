"use strict";

/** A trial on a canvas. Maps that are shown together share their camera. */
class TrialMap {
  constructor(trial, canvas, camera) {
    this.trial = trial;
    this.canvas = canvas;
    this.camera = camera;
    this.trails = new Trails();
    this.label = "";  // tells it from a map beside it
    this.ratio = 1;
  }

  has(layer) { return !layer.of || layer.of(this.trial); }

  /** What of a player's state is seen here: a trial that is over stays at its end, and may have fewer
      vehicles than the one beside it. */
  seen({time, selected}) {
    const {trial} = this;
    return {trial, time: Math.min(time, trial.end), over: time > trial.end,
            selected: selected < trial.size ? selected : -1};
  }

  /** The canvas has its size from the page. */
  resize() {
    const {width, height} = this.canvas.getBoundingClientRect();
    this.ratio = window.devicePixelRatio || 1;
    this.canvas.width = Math.round(width * this.ratio);
    this.canvas.height = Math.round(height * this.ratio);
    return {width, height};
  }

  draw(player) {
    if (this.camera.width < 1 || this.camera.height < 1) return;  // the page has no room for it yet
    const ctx = this.canvas.getContext("2d");
    // Of a size that is no whole number of pixels the last would stay half transparent.
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.fillStyle = look.paper;
    ctx.fillRect(0, 0, this.canvas.width, this.canvas.height);
    ctx.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    const scene = {...this.seen(player), camera: this.camera, look, trailSeconds: player.trailSeconds};
    for (const layer of LAYERS) {
      if (!player.shown.has(layer.name) || !this.has(layer)) continue;
      if (layer.name === "trails") this.trails.draw(ctx, scene, this.ratio);
      else layer.draw(ctx, scene);
    }
    drawScale(ctx, scene);
    if (player.shown.has("current") && this.trial.current) drawCurrentScale(ctx, scene);
  }

  /** Whether marks hide one another: a third of the vehicles share a square of their size. */
  crowded(player) {
    const {trial, time} = this.seen(player);
    const squares = new Map();
    let left = 0;
    for (let i = 0; i < trial.size; ++i) {
      if (trial.lost(i, time)) continue;
      const place = this.camera.toScreen(...trial.position(i, time));
      const square = place.map(pixel => Math.floor(pixel / VEHICLE_PIXELS)).join();
      squares.set(square, (squares.get(square) ?? 0) + 1);
      left += 1;
    }
    const sharing = [...squares.values()].reduce((sum, n) => sum + (n > 1 ? n : 0), 0);
    return sharing > 1 && sharing >= left / 3;
  }

  /** The vehicle nearest to a pixel, or -1 if none is near. */
  vehicleAt(player, px, py) {
    const {trial, time} = this.seen(player);
    let nearest = -1;
    let least = 20;  // pixels
    for (let i = 0; i < trial.size; ++i) {
      const [x, y] = this.camera.toScreen(...trial.position(i, time));
      const away = Math.hypot(x - px, y - py);
      if (away < least) [nearest, least] = [i, away];
    }
    return nearest;
  }
}
