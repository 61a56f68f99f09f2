"use strict";

/** Where vehicles have been. Kept on a canvas of its own, to which a frame adds what is new. */
class Trails {
  constructor() {
    this.canvas = document.createElement("canvas");
    this.drawn = null;  // what the canvas shows: up to when, seen how
  }

  draw(ctx, scene, ratio) {
    const {camera, time, trailSeconds} = scene;
    const seen = [camera.key, ratio, scene.look.name, trailSeconds].join();
    const goesOn = trailSeconds === Infinity && this.drawn && this.drawn.seen === seen
                   && time >= this.drawn.time;
    if (!goesOn) {
      this.canvas.width = Math.round(camera.width * ratio);  // clears it
      this.canvas.height = Math.round(camera.height * ratio);
    }
    const own = this.canvas.getContext("2d");
    own.setTransform(ratio, 0, 0, ratio, 0, 0);
    own.lineWidth = 1;
    own.lineJoin = "round";
    const from = goesOn ? this.drawn.time : Math.max(0, time - trailSeconds);
    if (time > from) {
      for (let i = 0; i < scene.trial.size; ++i) this.strokeVehicle(own, scene, i, from);
    }
    this.drawn = {time, seen};
    ctx.save();
    ctx.setTransform(1, 0, 0, 1, 0, 0);
    ctx.globalAlpha = 0.7;
    ctx.drawImage(this.canvas, 0, 0);
    ctx.restore();
  }

  strokeVehicle(own, {trial, camera, time, look}, vehicle, from) {
    const last = trial.instant(time);
    own.strokeStyle = vehicleColour(vehicle, look);
    own.beginPath();
    own.moveTo(...camera.toScreen(...trial.position(vehicle, from)));
    for (let k = trial.instant(from) + 1; k <= last; ++k) {
      const at = vehicle * trial.time.length + k;
      if (Number.isNaN(trial.columns.x[at])) break;
      own.lineTo(...camera.toScreen(trial.columns.x[at], trial.columns.y[at]));
    }
    if (!trial.lost(vehicle, time)) {
      own.lineTo(...camera.toScreen(...trial.position(vehicle, time)));
    }
    own.stroke();
  }
}
