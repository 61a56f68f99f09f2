"use strict";

// What the picture is made of. A layer draws one thing: its entry in LAYERS is all there is to it.
//
// A scene has: trial, camera, time, selected (a vehicle or -1), look (colours), trailSeconds.

const VEHICLE_PIXELS = 8;

/** Okabe and Ito 2008 with two darkened, as in the figures; black is the ink of the page. */
const COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#BF8500", "#2F96CF", "ink"];

function vehicleColour(vehicle, look) {
  const colour = COLOURS[vehicle % COLOURS.length];
  return colour === "ink" ? look.ink : colour;
}

const LAYERS = [
  {name: "current", label: "Current", shown: true, of: trial => trial.current !== null,
   draw: drawCurrent},
  {name: "obstacles", label: "Obstacles", shown: true, of: trial => trial.data.obstacles.length > 0,
   draw: drawObstacles},
  {name: "plan", label: "Best-fit plan", shown: false, of: trial => trial.matchTime.length > 0,
   draw: drawPlan},
  {name: "trails", label: "Trails", shown: true, draw: null},  // kept by the class Trails
  {name: "ends", label: "Starts and ends", shown: true, draw: drawEnds},
  {name: "waypoint", label: "Waypoint", shown: true, of: trial => trial.data.waypoint !== null,
   draw: drawWaypoint},
  {name: "targets", label: "Targets", shown: false, of: trial => trial.columns.target_x,
   draw: drawTargets},
  {name: "drift", label: "Drifting radius", shown: false,
   of: trial => trial.data.drifting_radius_m !== null, draw: drawDriftingRadius},
  {name: "range", label: "Range and links", shown: true, draw: drawRange},
  {name: "vehicles", label: "Vehicles", shown: true, draw: drawVehicles},
];

function drawCurrent(ctx, {trial, camera, time, look}) {
  const current = trial.current;
  const slice = lastAtOrBefore(current.times, time) * current.x.length * current.y.length;
  // The fastest water seen reaches as far as the next arrow.
  const pixels = 0.9 * current.spacing * camera.scale / Math.max(current.fastest, 1e-9);
  ctx.strokeStyle = ctx.fillStyle = look.current;
  ctx.lineWidth = 1;
  current.y.forEach((y, row) => current.x.forEach((x, column) => {
    const at = slice + row * current.x.length + column;
    const [u, v] = [current.u[at], current.v[at]];
    if (Number.isNaN(u) || Math.hypot(u, v) * pixels < 1) return;
    const [px, py] = camera.toScreen(x, y);
    arrow(ctx, px - u * pixels / 2, py + v * pixels / 2, px + u * pixels / 2, py - v * pixels / 2);
  }));
}

/** What an arrow of the picture's current stands for. */
function drawCurrentScale(ctx, {trial, camera, look}) {
  const {spacing, fastest} = trial.current;
  const pixels = 0.9 * spacing * camera.scale / Math.max(fastest, 1e-9);
  if (!(fastest * pixels >= 1)) return;  // no arrow is drawn
  const rough = Math.max(Math.min(fastest, 90 / pixels), 20 / pixels);  // of short arrows more than one
  const power = 10 ** Math.floor(Math.log10(rough));
  const speed = [5, 2, 1].map(digit => digit * power).find(each => each <= rough);
  const [x, y] = [14, camera.height - 42];
  ctx.strokeStyle = ctx.fillStyle = look.ink;
  ctx.lineWidth = 1.5;
  arrow(ctx, x, y, x + speed * pixels, y);
  ctx.font = "12px system-ui, sans-serif";
  ctx.fillText(`${numberText(speed)} m/s`, x + 5, y - 6);
}

function arrow(ctx, x0, y0, x1, y1) {
  const angle = Math.atan2(y1 - y0, x1 - x0);
  const head = Math.min(5, 0.5 * Math.hypot(x1 - x0, y1 - y0));
  ctx.beginPath();
  ctx.moveTo(x0, y0);
  ctx.lineTo(x1, y1);
  for (const side of [-1, 1]) {
    ctx.moveTo(x1, y1);
    ctx.lineTo(x1 - head * Math.cos(angle + side * 0.5), y1 - head * Math.sin(angle + side * 0.5));
  }
  ctx.stroke();
}

function drawObstacles(ctx, {trial, camera, look}) {
  ctx.fillStyle = look.ground;
  ctx.strokeStyle = look.quiet;
  ctx.lineWidth = 1;
  for (const outline of trial.data.obstacles) {
    ctx.beginPath();
    for (const [x, y] of outline) ctx.lineTo(...camera.toScreen(x, y));
    ctx.closePath();
    ctx.fill();
    ctx.stroke();
  }
}

function drawPlan(ctx, {trial, camera, time, look}) {
  const plan = trial.fittedPlan(time);
  if (!plan) return;
  ctx.strokeStyle = look.ink;
  ctx.lineWidth = 1;
  for (const place of plan) {
    const [x, y] = camera.toScreen(...place);
    ctx.strokeRect(x - 6, y - 6, 12, 12);
  }
}

/** Crosses where vehicles start, circles where they end: Rypkema 2015, chapter 5. */
function drawEnds(ctx, {trial, camera, look}) {
  ctx.lineWidth = 1.5;
  for (let i = 0; i < trial.size; ++i) {
    const [x, y] = camera.toScreen(...trial.position(i, 0));
    ctx.strokeStyle = look.ink;
    cross(ctx, x, y, 4);
    ctx.strokeStyle = look.accent;
    circle(ctx, ...camera.toScreen(...trial.lastSeen(i).place), 4);
  }
}

function cross(ctx, x, y, reach) {
  ctx.beginPath();
  ctx.moveTo(x - reach, y - reach);
  ctx.lineTo(x + reach, y + reach);
  ctx.moveTo(x + reach, y - reach);
  ctx.lineTo(x - reach, y + reach);
  ctx.stroke();
}

function circle(ctx, x, y, radius) {
  ctx.beginPath();
  ctx.arc(x, y, radius, 0, 2 * Math.PI);
  ctx.stroke();
}

function drawWaypoint(ctx, {trial, camera, look}) {
  const [x, y] = camera.toScreen(...trial.data.waypoint);
  ctx.strokeStyle = ctx.fillStyle = look.ink;
  ctx.beginPath();
  for (let k = 0; k < 10; ++k) {
    const angle = Math.PI * k / 5;
    const radius = k % 2 ? 4 : 9;
    ctx.lineTo(x + radius * Math.sin(angle), y - radius * Math.cos(angle));
  }
  ctx.closePath();
  ctx.fill();
  ctx.setLineDash([4, 4]);
  ctx.lineWidth = 1;
  circle(ctx, x, y, trial.data.arrival_radius_m * camera.scale);
  ctx.setLineDash([]);
}

/** The target of a vehicle: a line to its target. */
function drawTargets(ctx, {trial, camera, time, look}) {
  ctx.strokeStyle = look.accent;
  ctx.lineWidth = 1;
  for (let i = 0; i < trial.size; ++i) {
    const [x, y] = trial.position(i, time);
    const [dx, dy] = [trial.value("target_x", i, time), trial.value("target_y", i, time)];
    if (Number.isNaN(x + dx)) continue;
    ctx.beginPath();
    ctx.moveTo(...camera.toScreen(x, y));
    ctx.lineTo(...camera.toScreen(x + dx, y + dy));
    ctx.stroke();
  }
}

function drawDriftingRadius(ctx, {trial, camera, time, look}) {
  ctx.strokeStyle = look.quiet;
  ctx.lineWidth = 1;
  for (let i = 0; i < trial.size; ++i) {
    const [x, y] = trial.position(i, time);
    if (Number.isNaN(x)) continue;
    circle(ctx, ...camera.toScreen(x, y), trial.data.drifting_radius_m * camera.scale);
  }
}

/** How far the selected vehicle is heard, and which vehicles hear it. */
function drawRange(ctx, scene) {
  const {trial, camera, time, selected, look} = scene;
  if (selected < 0 || trial.lost(selected, time)) return;
  const here = camera.toScreen(...trial.position(selected, time));
  ctx.strokeStyle = look.accent;
  ctx.lineWidth = 1;
  ctx.setLineDash([6, 4]);
  circle(ctx, ...here, trial.data.range_m * camera.scale);
  ctx.setLineDash([]);
  ctx.globalAlpha = 0.5;
  for (const other of inRange(trial, selected, time)) {
    ctx.beginPath();
    ctx.moveTo(...here);
    ctx.lineTo(...camera.toScreen(...trial.position(other, time)));
    ctx.stroke();
  }
  ctx.globalAlpha = 1;
}

/** The vehicles in acoustic range of one. */
function inRange(trial, vehicle, time) {
  const [x, y] = trial.position(vehicle, time);
  const found = [];
  for (let i = 0; i < trial.size; ++i) {
    if (i === vehicle) continue;
    const [xi, yi] = trial.position(i, time);
    if (Math.hypot(xi - x, yi - y) <= trial.data.range_m) found.push(i);
  }
  return found;
}

/** Filled while it thrusts, hollow while it drifts; pointed to where it heads. */
function drawVehicles(ctx, {trial, camera, time, selected, look}) {
  ctx.lineWidth = 1.5;
  for (let i = 0; i < trial.size; ++i) {
    if (trial.lost(i, time)) {
      drawLost(ctx, camera.toScreen(...trial.lastSeen(i).place), look);
      continue;
    }
    const [x, y] = camera.toScreen(...trial.position(i, time));
    const heading = trial.heading(i, time) * Math.PI / 180;
    ctx.beginPath();
    for (const [ahead, right] of [[1.2, 0], [-0.8, 0.7], [-0.4, 0], [-0.8, -0.7]]) {
      ctx.lineTo(x + VEHICLE_PIXELS * (ahead * Math.sin(heading) + right * Math.cos(heading)),
                 y - VEHICLE_PIXELS * (ahead * Math.cos(heading) - right * Math.sin(heading)));
    }
    ctx.closePath();
    ctx.strokeStyle = vehicleColour(i, look);
    ctx.fillStyle = trial.mode(i, time).thrusting ? ctx.strokeStyle : look.paper;
    ctx.fill();
    ctx.stroke();
    if (i === selected) {
      ctx.strokeStyle = look.accent;
      circle(ctx, x, y, 2 * VEHICLE_PIXELS);
    }
  }
}

function drawLost(ctx, [x, y], look) {
  ctx.strokeStyle = look.quiet;
  circle(ctx, x, y, 5);
  cross(ctx, x, y, 3);
}

/** A round length of about a fifth of the picture, and the north. */
function drawScale(ctx, {camera, look}) {
  const most = camera.width / 5 / camera.scale;
  const power = 10 ** Math.floor(Math.log10(most));
  const metres = [5, 2, 1].map(digit => digit * power).find(length => length <= most);
  const [x, y] = [14, camera.height - 16];
  ctx.strokeStyle = ctx.fillStyle = look.ink;
  ctx.lineWidth = 1.5;
  ctx.beginPath();
  ctx.moveTo(x, y - 4);
  ctx.lineTo(x, y);
  ctx.lineTo(x + metres * camera.scale, y);
  ctx.lineTo(x + metres * camera.scale, y - 4);
  ctx.stroke();
  ctx.font = "12px system-ui, sans-serif";
  ctx.fillText(metres >= 1000 ? `${metres / 1000} km` : `${metres} m`, x + 5, y - 5);
  arrow(ctx, camera.width - 18, camera.height - 14, camera.width - 18, camera.height - 38);
  ctx.fillText("N", camera.width - 22, camera.height - 42);
}
