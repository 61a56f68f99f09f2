"use strict";

/** What of the plane is seen: metres in the middle, pixels to a metre. */
class Camera {
  constructor() {
    this.width = this.height = 1;
    this.x = this.y = 0;
    this.scale = 1;
  }

  toScreen(x, y) {
    return [this.width / 2 + (x - this.x) * this.scale, this.height / 2 - (y - this.y) * this.scale];
  }

  toPlane(px, py) {
    return [this.x + (px - this.width / 2) / this.scale, this.y - (py - this.height / 2) / this.scale];
  }

  fit({x, y}) {
    const margin = 36;  // pixels
    this.x = (x[0] + x[1]) / 2;
    this.y = (y[0] + y[1]) / 2;
    this.scale = Math.min((this.width - 2 * margin) / Math.max(x[1] - x[0], 20),
                          (this.height - 2 * margin) / Math.max(y[1] - y[0], 20));
    this.scale = Math.max(this.scale, 1e-4);
  }

  /** The place under a pixel stays where it is. */
  zoom(factor, px = this.width / 2, py = this.height / 2) {
    const before = this.toPlane(px, py);
    this.scale = Math.min(Math.max(this.scale * factor, 1e-4), 100);
    const after = this.toPlane(px, py);
    this.x += before[0] - after[0];
    this.y += before[1] - after[1];
  }

  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
  }

  /** Differs wherever the picture does. */
  get key() {
    return [this.width, this.height, this.x, this.y, this.scale].join();
  }
}

/** The [least, greatest] that hold all of several. */
function aroundAll(bounds) {
  const along = axis => [Math.min(...bounds.map(each => each[axis][0])),
                         Math.max(...bounds.map(each => each[axis][1]))];
  return {x: along("x"), y: along("y")};
}
