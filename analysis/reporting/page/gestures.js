"use strict";

/** Mouse, fingers and wheel on a map: drag to pan, pinch or turn the wheel to zoom, and click a
    vehicle. */
function takeGestures(player, map) {
  const {canvas, camera} = map;
  const fingers = new Map();
  let moved = 0;

  const place = event => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const between = () => {
    const [a, b] = [...fingers.values()];
    return {away: Math.hypot(a[0] - b[0], a[1] - b[1]), x: (a[0] + b[0]) / 2, y: (a[1] + b[1]) / 2};
  };

  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    if (fingers.size === 0) moved = 0;
    fingers.set(event.pointerId, place(event));
  });
  canvas.addEventListener("pointermove", event => {
    if (!fingers.has(event.pointerId)) return;
    const [px, py] = place(event);
    const [x, y] = fingers.get(event.pointerId);
    const before = fingers.size === 2 ? between() : null;
    fingers.set(event.pointerId, [px, py]);
    moved += Math.hypot(px - x, py - y);
    if (before) {
      const after = between();
      camera.zoom(after.away / Math.max(before.away, 1), after.x, after.y);
      camera.pan(after.x - before.x, after.y - before.y);
    } else {
      camera.pan(px - x, py - y);
    }
    player.changed();
  });
  const lift = event => {
    const only = fingers.size === 1;
    if (!fingers.delete(event.pointerId)) return;
    if (event.type === "pointerup" && only && moved < 5) {
      player.select(map.vehicleAt(player, ...place(event)));
    }
  };
  canvas.addEventListener("pointerup", lift);
  canvas.addEventListener("pointercancel", lift);
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    camera.zoom(Math.exp(-event.deltaY * 0.0015), ...place(event));
    player.changed();
  }, {passive: false});
}

/** What a key does: shown on the page, and done. */
const KEYS = [
  {keys: [" ", "k"], text: "Space or K", does: "play or pause",
   act: player => player.playing ? player.pause() : player.play()},
  {keys: [",", "ArrowLeft"], text: ", or ←", does: "one instant back", act: player => player.step(-1)},
  {keys: [".", "ArrowRight"], text: ". or →", does: "one instant on", act: player => player.step(1)},
  {keys: ["Home"], text: "Home", does: "to the start", act: player => player.seek(0)},
  {keys: ["End"], text: "End", does: "to the end", act: player => player.seek(player.end)},
  {keys: ["+", "="], text: "+", does: "closer", act: player => player.camera.zoom(1.3)},
  {keys: ["-"], text: "−", does: "farther", act: player => player.camera.zoom(1 / 1.3)},
  {keys: ["0"], text: "0", does: "everything in view", act: player => player.fit()},
  {keys: ["w"], text: "W A S D", does: "move the view", act: player => player.camera.pan(0, 40)},
  {keys: ["a"], act: player => player.camera.pan(40, 0)},
  {keys: ["s"], act: player => player.camera.pan(0, -40)},
  {keys: ["d"], act: player => player.camera.pan(-40, 0)},
  {keys: ["]", "n"], text: "N or ]", does: "next vehicle", act: player => selectNext(player, 1)},
  {keys: ["[", "p"], text: "P or [", does: "vehicle before", act: player => selectNext(player, -1)},
  {keys: ["Escape"], text: "Esc", does: "no vehicle", act: player => player.select(-1)},
];

function selectNext(player, by) {
  const count = player.names.length;
  player.select(player.selected < 0 ? (by > 0 ? 0 : count - 1)
                                    : (player.selected + by + count) % count);
}

/** Keys act wherever the focus is, unless it is on something that needs them itself. */
function takeKeys(player) {
  document.addEventListener("keydown", event => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const at = event.target;
    if (["SELECT", "TEXTAREA"].includes(at.tagName) || (at.tagName === "INPUT" && at.type === "text")) {
      return;
    }
    const pressed = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const own = {" ": "BUTTON INPUT SUMMARY A", ArrowLeft: "INPUT", ArrowRight: "INPUT", Home: "INPUT",
                 End: "INPUT"}[pressed] ?? "";
    if (own.split(" ").includes(at.tagName)) return;
    const onMap = player.maps.some(map => map.canvas === at);
    if (["Home", "End"].includes(pressed) && !onMap) return;  // they scroll the page
    const entry = KEYS.find(each => each.keys.includes(pressed));
    if (!entry) return;
    event.preventDefault();
    entry.act(player);
    player.changed();
  });
}
