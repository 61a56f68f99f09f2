"use strict";

/** The rigid motion of slots onto places with the least weighted squares (Horn 1987 in the plane), or
    null where it has no angle. */
function fitted(pairs, weights) {
  const all = weights.reduce((sum, weight) => sum + weight, 0);
  const mean = side => [0, 1].map(
    axis => pairs.reduce((sum, pair, i) => sum + weights[i] * pair[side][axis], 0) / all);
  const [from, to] = [mean(0), mean(1)];
  let cosine = 0;
  let sine = 0;
  pairs.forEach(([slot, place], i) => {
    const [sx, sy, px, py] = [slot[0] - from[0], slot[1] - from[1],
                              place[0] - to[0], place[1] - to[1]];
    cosine += weights[i] * (sx * px + sy * py);
    sine += weights[i] * (sx * py - sy * px);
  });
  const size = Math.hypot(cosine, sine);
  if (size === 0) return null;
  [cosine, sine] = [cosine / size, sine / size];
  return ([x, y]) => [to[0] + cosine * (x - from[0]) - sine * (y - from[1]),
                      to[1] + sine * (x - from[0]) + cosine * (y - from[1])];
}

/** A recorded trial: numbers of each vehicle at any time, metres east and north, degrees of the
    compass. */
class Trial {
  constructor(data) {
    this.data = data;
    this.names = data.vehicles;
    this.size = data.vehicles.length;
    this.time = unpackFloats(data.time_s);
    this.columns = {x: unpackSteps(data.tracks.x), y: unpackSteps(data.tracks.y),
                    mode: bytesOf(data.tracks.mode)};
    for (const [name, packed] of Object.entries(data.tracks.levels)) {
      this.columns[name] = unpackLevels(packed);
    }
    this.current = data.current && {
      ...data.current, times: unpackFloats(data.current.times), u: unpackLevels(data.current.u),
      v: unpackLevels(data.current.v)};
    this.matchTime = unpackFloats(data.matches.time_s);
    this.matches = new Uint16Array(bytesOf(data.matches.slots).buffer);
  }

  get end() { return this.time[this.time.length - 1]; }

  /** The last recorded instant at or before a time. */
  instant(time) { return lastAtOrBefore(this.time, time); }

  instantAfter(time) { return this.time[this.instant(time) + 1] ?? Infinity; }

  instantBefore(time) {
    const k = this.instant(time);
    return this.time[time > this.time[k] ? k : Math.max(k - 1, 0)];
  }

  /** A recorded number, between instants on a straight line. */
  value(name, vehicle, time) {
    const column = this.columns[name];
    const k = this.instant(time);
    const at = vehicle * this.time.length + k;
    const gone = time - this.time[k];
    if (gone <= 0 || k + 1 === this.time.length) return column[at];
    return column[at] + (column[at + 1] - column[at]) * gone / (this.time[k + 1] - this.time[k]);
  }

  position(vehicle, time) {
    return [this.value("x", vehicle, time), this.value("y", vehicle, time)];
  }

  heading(vehicle, time) {
    const column = this.columns.heading;
    const k = this.instant(time);
    const at = vehicle * this.time.length + k;
    if (k + 1 === this.time.length) return column[at];
    const turn = ((column[at + 1] - column[at] + 540) % 360) - 180;  // the shorter way
    return column[at] + turn * (time - this.time[k]) / (this.time[k + 1] - this.time[k]);
  }

  mode(vehicle, time) {
    const mode = this.columns.mode[vehicle * this.time.length + this.instant(time)];
    return {thrusting: (mode & 1) === 1, reason: this.data.reasons[mode >> 1]};
  }

  lost(vehicle, time) {
    return Number.isNaN(this.columns.x[vehicle * this.time.length + this.instant(time)]);
  }

  /** Time and place of the last record of a vehicle. */
  lastSeen(vehicle) {
    let k = this.time.length - 1;
    while (k > 0 && Number.isNaN(this.columns.x[vehicle * this.time.length + k])) --k;
    const at = vehicle * this.time.length + k;
    return {time: this.time[k], place: [this.columns.x[at], this.columns.y[at]]};
  }

  /** Slots of the plan that vehicles were matched to, last before a time; lost ones have none. */
  slots(time) {
    const row = lastAtOrBefore(this.matchTime, time) * this.size;
    return this.matches.subarray(row, row + this.size);
  }

  /** Where the plan lies that fits the vehicles best, as pairs (or null where none is left): at the
      least sum of distances, as the formation quality lays it. Weiszfeld's iteration of weighted
      least squares. */
  fittedPlan(time) {
    if (this.matchTime.length === 0) return null;
    const slots = this.slots(time);
    const pairs = [];
    for (let i = 0; i < this.size; ++i) {
      if (slots[i] < this.data.plan.length && !this.lost(i, time)) {
        pairs.push([this.data.plan[slots[i]], this.position(i, time)]);
      }
    }
    if (pairs.length < 2) return null;
    let move = fitted(pairs, pairs.map(() => 1));
    for (let step = 0; move && step < 50; ++step) {
      const away = pairs.map(([slot, place]) => {
        const [x, y] = move(slot);
        return Math.hypot(x - place[0], y - place[1]);
      });
      move = fitted(pairs, away.map(distance => 1 / Math.max(distance, 1e-3)));
    }
    return move && this.data.plan.map(move);
  }

  /** [least, greatest] of everywhere that vehicles, obstacles and the waypoint are. */
  bounds() {
    const bounds = {x: [Infinity, -Infinity], y: [Infinity, -Infinity]};
    const hold = (axis, number) => {
      if (Number.isNaN(number)) return;
      bounds[axis][0] = Math.min(bounds[axis][0], number);
      bounds[axis][1] = Math.max(bounds[axis][1], number);
    };
    for (const axis of ["x", "y"]) this.columns[axis].forEach(number => hold(axis, number));
    const places = this.data.obstacles.flat();
    if (this.data.waypoint) places.push(this.data.waypoint);
    for (const [x, y] of places) {
      hold("x", x);
      hold("y", y);
    }
    return bounds;
  }
}

function lastAtOrBefore(times, time) {
  let low = 0;
  let high = times.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= time) low = middle;
    else high = middle - 1;
  }
  return low;
}
