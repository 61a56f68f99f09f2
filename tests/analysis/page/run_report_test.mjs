// The report of a run in a real browser: every control does what it says.
//
//     SHOAL=build/ci/bin/shoal node --test run_report_test.mjs

import assert from "node:assert/strict";
import {after, before, test} from "node:test";
import {join} from "node:path";
import {launch, open, shoal, workFolder} from "./browser.mjs";

const folder = workFolder();
let browser;

before(async () => {
  browser = await launch();
  shoal("run", "redsea_square", "--set", "trial.duration_s=7500", "--out", join(folder, "redsea"));
  shoal("run", "potentials_clutter", "--out", join(folder, "clutter"));
  shoal("run", "redsea_square", "--set", "trial.duration_s=1200", "--set",
        "faults.node_loss={every_s=300,count=3}", "--set", "quality.layers=0", "--out", join(folder, "losses"));
});
after(() => browser.close());

const report = name => join(folder, name, "report.html");

/** The page with time in the hands of the test. */
async function opened(name, options) {
  const page = await open(browser, report(name), options);
  await page.evaluate(() => { window.shoal.player.heldByHand = true; });
  return page;
}

const state = page => page.evaluate(() => {
  const {player} = window.shoal;
  return {time: player.time, playing: player.playing, speed: player.speed, selected: player.selected,
          x: player.camera.x, y: player.camera.y, scale: player.camera.scale, end: player.trial.end};
});

/** What is on the canvas now. */
const picture = page => page.evaluate(() => {
  window.shoal.player.draw();
  return window.shoal.player.canvas.toDataURL();
});

const advance = (page, ms) => page.evaluate(by => window.shoal.player.advance(by), ms);

test("plays at the speed it says, pauses, and starts again from the end", async () => {
  const page = await opened("redsea");
  await page.selectOption("#speed", "60");
  await page.click("#play");
  assert.equal(await page.textContent("#play"), "Pause");
  await advance(page, 500);
  await advance(page, 500);
  assert.equal((await state(page)).time, 60);
  assert.match(await page.textContent("#clock"), /^0:01:00 \/ 2:05:00$/);
  await page.click("#play");
  await advance(page, 1000);
  assert.equal((await state(page)).time, 60);
  await page.selectOption("#speed", "3600");
  await page.click("#play");
  await advance(page, 5000);
  let now = await state(page);
  assert.deepEqual([now.time, now.playing], [7500, false]);
  await page.click("#play");
  now = await state(page);
  assert.deepEqual([now.time, now.playing], [0, true]);
  page.quiet();
});

test("moves by itself when nobody holds the time", async () => {
  const page = await open(browser, report("redsea"));
  await page.click("#play");
  await page.waitForFunction(() => window.shoal.player.time > 0);
  page.quiet();
});

test("steps to the recorded instants, and scrubs anywhere", async () => {
  const page = await opened("redsea");
  await page.click("#on");
  assert.equal((await state(page)).time, 5);
  await page.evaluate(() => window.shoal.player.seek(12));
  await page.click("#back");
  assert.equal((await state(page)).time, 10);
  await page.click("#back");
  assert.equal((await state(page)).time, 5);
  await page.locator("#scrub").fill("3000");
  assert.equal((await state(page)).time, 3000);
  await page.focus("#scrub");
  await page.keyboard.press("ArrowRight");
  assert.equal((await state(page)).time, 3005);
  page.quiet();
});

test("every layer can be shown and hidden", async () => {
  for (const [name, wanted] of [["redsea", ["current", "plan", "trails", "ends", "targets", "drift",
                                            "range", "vehicles"]],
                                ["clutter", ["obstacles", "plan", "trails", "ends", "waypoint",
                                             "targets", "drift", "range", "vehicles"]]]) {
    const page = await opened(name);
    await page.evaluate(() => {
      const {player} = window.shoal;
      player.seek(0.6 * player.trial.end);
      player.select(1);
    });
    const boxes = await page.$$eval("#layers input", all => all.map(box => box.id));
    assert.deepEqual(boxes, wanted.map(layer => `layer-${layer}`));
    for (const box of boxes) {
      const before = await picture(page);
      await page.locator(`#${box}`).click();
      const without = await picture(page);
      if (box !== "layer-targets" || name === "redsea") {  // potentials push and have no target
        assert.notEqual(without, before, `${name}: ${box}`);
      }
      await page.locator(`#${box}`).click();
      assert.equal(await picture(page), before, `${name}: ${box} again`);
    }
    page.quiet();
  }
});

test("trails can be short, and come out the same played or scrubbed", async () => {
  const page = await opened("redsea");
  await page.selectOption("#speed", "600");
  await page.click("#play");
  for (let k = 0; k < 10; ++k) {
    await advance(page, 300);
    await page.evaluate(() => window.shoal.player.draw());
  }
  await page.click("#play");
  const pixels = await page.evaluate(() => {
    const {player} = window.shoal;
    const colours = () => {
      player.draw();
      const {canvas} = player.maps[0].trails;
      const copy = document.createElement("canvas");
      [copy.width, copy.height] = [canvas.width, canvas.height];
      copy.getContext("2d").drawImage(canvas, 0, 0);
      const {data} = copy.getContext("2d").getImageData(0, 0, copy.width, copy.height);
      let count = 0;
      for (let k = 3; k < data.length; k += 4) count += data[k] > 0;
      return count;
    };
    const played = colours();
    const time = player.time;
    player.seek(0);
    player.draw();
    player.seek(time);
    return {played, scrubbed: colours(), time};
  });
  assert.equal(pixels.time, 1800);
  // Pieces that meet cover the same pixels, up to their edges.
  assert.ok(Math.abs(pixels.played - pixels.scrubbed) < 0.02 * pixels.scrubbed, JSON.stringify(pixels));
  const whole = await picture(page);
  await page.selectOption("#trail", "600");
  assert.notEqual(await picture(page), whole);
  page.quiet();
});

test("zooms, pans and fits, by buttons, wheel, mouse and keys", async () => {
  const page = await opened("redsea");
  const first = await state(page);
  await page.click("#closer");
  assert.ok(Math.abs((await state(page)).scale / first.scale - 1.3) < 1e-9);
  await page.click("#farther");
  await page.locator("#map").hover({position: {x: 100, y: 100}});
  await page.mouse.wheel(0, -300);
  await page.waitForFunction(scale => window.shoal.player.camera.scale > 1.2 * scale, first.scale);
  await page.click("#fit");
  assert.equal((await state(page)).scale, first.scale);

  const box = await page.locator("#map").boundingBox();
  await page.mouse.move(box.x + 200, box.y + 200);
  await page.mouse.down();
  await page.mouse.move(box.x + 260, box.y + 170, {steps: 3});
  await page.mouse.up();
  const moved = await state(page);
  assert.ok(Math.abs((first.x - moved.x) * first.scale - 60) < 1e-6);
  assert.ok(Math.abs((moved.y - first.y) * first.scale + 30) < 1e-6);
  assert.equal(moved.selected, -1);

  await page.locator("#map").focus();
  await page.keyboard.press("0");
  await page.keyboard.press("+");
  await page.keyboard.press("d");
  const keyed = await state(page);
  assert.ok(keyed.scale > first.scale && keyed.x > first.x);
  page.quiet();
});

test("a clicked vehicle shows its own numbers", async () => {
  const page = await opened("redsea");
  const place = await page.evaluate(() => {
    const {player, trial} = window.shoal;
    player.seek(3600);
    const [x, y] = player.camera.toScreen(...trial.position(7, 3600));
    return {x, y, name: trial.names[7], east: trial.position(7, 3600)[0]};
  });
  await page.locator("#map").click({position: {x: place.x, y: place.y}});
  assert.equal((await state(page)).selected, 7);
  assert.equal(await page.$eval("#vehicle", list => list.selectedOptions[0].textContent), place.name);
  const text = await page.textContent("#numbers");
  assert.ok(text.includes(`${place.east.toFixed(1)} m`), text);
  for (const part of ["State", "Heading", "Energy", "Wh", "m/s", "In range"]) {
    assert.ok(text.includes(part), part);
  }
  assert.match(await page.textContent("#said"), new RegExp(`Vehicle ${place.name} is selected`));
  await page.locator("#map").click({position: {x: 5, y: 5}});
  assert.equal((await state(page)).selected, -1);
  assert.equal(await page.textContent("#numbers"), "");
  page.quiet();
});

test("lost vehicles stay where they were last seen", async () => {
  const page = await opened("losses");
  const lost = await page.evaluate(() => {
    const {player, trial} = window.shoal;
    player.seek(trial.end);
    const all = trial.names.map((name, i) => i).filter(i => trial.lost(i, trial.end));
    player.select(all[0]);
    return {all, seen: trial.lastSeen(all[0])};
  });
  assert.equal(lost.all.length, 3);
  assert.ok(lost.seen.time < 1200 && lost.seen.place.every(Number.isFinite));
  assert.match(await page.textContent("#numbers"), /lost after 0:\d\d:\d\d/);
  assert.match(await page.textContent("#said"), /of 17 vehicles thrust, 3 are lost/);
  page.quiet();
});

test("the best-fit plan lies where the vehicles are, and ignores lost ones", async () => {
  const page = await opened("losses");
  const away = await page.evaluate(() => {
    const {trial} = window.shoal;
    const plan = trial.fittedPlan(trial.end);
    const slots = trial.slots(trial.end);
    let sum = 0;
    let count = 0;
    for (let i = 0; i < trial.size; ++i) {
      if (trial.lost(i, trial.end)) continue;
      const [x, y] = trial.position(i, trial.end);
      sum += Math.hypot(plan[slots[i]][0] - x, plan[slots[i]][1] - y);
      ++count;
    }
    const quality = trial.data.measures.find(each => each.name === "quality_final_m").value;
    return {mean: sum / count, quality,
            used: new Set(slots.filter(slot => slot < plan.length)).size};
  });
  assert.equal(away.used, 17);
  // That is the formation quality, measured on a plan that is not padded.
  assert.ok(Math.abs(away.mean - away.quality) < 0.02, `${away.mean} m, ${away.quality} m`);
  page.quiet();
});

test("everything works from the keyboard alone", async () => {
  const page = await opened("redsea");
  const reached = new Set();
  for (let k = 0; k < 40; ++k) {
    await page.keyboard.press("Tab");
    reached.add(await page.evaluate(() => document.activeElement.id || document.activeElement.tagName));
  }
  for (const id of ["look", "map", "play", "back", "on", "scrub", "speed", "closer", "farther", "fit",
                    "trail", "vehicle", "layer-vehicles", "SUMMARY", "save"]) {
    assert.ok(reached.has(id), `${id} is never reached`);
  }
  await page.locator("#map").focus();
  await page.keyboard.press("Space");
  assert.equal((await state(page)).playing, true);
  await page.keyboard.press("k");
  assert.equal((await state(page)).playing, false);
  await page.keyboard.press(".");
  assert.equal((await state(page)).time, 5);
  await page.keyboard.press("End");
  assert.equal((await state(page)).time, 7500);
  await page.keyboard.press("Home");
  assert.equal((await state(page)).time, 0);
  await page.keyboard.press("n");
  await page.keyboard.press("n");
  assert.equal((await state(page)).selected, 1);
  await page.keyboard.press("p");
  assert.equal((await state(page)).selected, 0);
  await page.keyboard.press("Escape");
  assert.equal((await state(page)).selected, -1);
  // A focused button gets its own space bar.
  await page.focus("#fit");
  await page.keyboard.press("Space");
  assert.equal((await state(page)).playing, false);
  page.quiet();
});

test("charts are linked with the playback", async () => {
  const page = await opened("redsea");
  const titles = await page.$$eval(".chart figcaption b", all => all.map(each => each.textContent));
  for (const part of [/energy/i, /quality/i, /time.*(command|thrust)|thrust.*time/i]) {
    assert.ok(titles.some(title => part.test(title)), `${part} in ${titles}`);
  }
  const place = () => page.$eval(".now", line => parseFloat(line.style.left));
  const before = await place();
  const over = page.locator(".chart .u-over").first();
  const box = await over.boundingBox();
  await over.click({position: {x: 0.5 * box.width, y: 20}});
  const {time} = await state(page);
  assert.ok(Math.abs(time - 3750) < 40, String(time));
  assert.ok(await place() > before);
  page.quiet();
});

test("says what an arrow of the current stands for, and where vehicles hide one another", async () => {
  const page = await opened("redsea");
  const [fitted, far, hints] = await page.evaluate(() => {
    const {player} = window.shoal;
    const crowd = document.getElementById("crowd");
    const fitted = player.crowded();
    player.camera.zoom(0.01);
    player.changed();
    return [fitted, player.crowded(), !crowd.hidden];
  });
  assert.deepEqual([fitted, far, hints], [false, true, true]);
  page.quiet();
});

test("measures, scenario and how to run it again are there", async () => {
  const page = await opened("redsea");
  const rows = await page.$$eval("#measures tr", all => all.map(row => row.textContent));
  assert.ok(rows.length > 20);
  assert.ok(rows.some(row => row.startsWith("energy_mean_wh")));
  const scenario = await page.textContent("#scenario");
  assert.match(scenario, /\[trial\]/);
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save")]);
  assert.equal(download.suggestedFilename(), "scenario.toml");
  page.quiet();
});

test("light and dark, and both are what the system says at first", async () => {
  const paper = page => page.evaluate(() => getComputedStyle(document.documentElement)
    .getPropertyValue("--name").trim());
  const light = await opened("redsea", {colorScheme: "light"});
  assert.equal(await paper(light), "light");
  const before = await picture(light);
  await light.click("#look");
  assert.equal(await paper(light), "dark");
  assert.notEqual(await picture(light), before);
  await light.click("#look");
  assert.equal(await picture(light), before);
  const dark = await opened("redsea", {colorScheme: "dark"});
  assert.equal(await paper(dark), "dark");
  light.quiet();
  dark.quiet();
});

test("fits on a phone, where two fingers zoom", async () => {
  const page = await opened("redsea", {viewport: {width: 375, height: 740}, hasTouch: true,
                                       isMobile: true});
  const wide = await page.evaluate(() => document.scrollingElement.scrollWidth);
  assert.ok(wide <= 375, `${wide} pixels`);
  const before = await state(page);
  await page.evaluate(() => {
    const {canvas} = window.shoal.player;
    const touch = (kind, id, x) => canvas.dispatchEvent(new PointerEvent(kind, {
      pointerId: id, clientX: canvas.getBoundingClientRect().left + x,
      clientY: canvas.getBoundingClientRect().top + 150, pointerType: "touch"}));
    canvas.setPointerCapture = () => {};  // made-up fingers cannot be captured
    touch("pointerdown", 1, 150);
    touch("pointerdown", 2, 200);
    touch("pointermove", 1, 100);
    touch("pointermove", 2, 250);
    touch("pointerup", 1, 100);
    touch("pointerup", 2, 250);
  });
  const after = await state(page);
  assert.ok(Math.abs(after.scale / before.scale - 3) < 1e-6, `${after.scale / before.scale}`);
  page.quiet();
});

test("two hundred vehicles: the time of a frame is printed", async () => {
  shoal("run", "redsea_square", "--set", "plan.square={rows=10,columns=20,separation_m=150}", "--set",
        "trial.duration_s=3600", "--set", "swarm.start.box.side_m=3000", "--set",
        "quality.every_s=600", "--set", "current.kind=vortex", "--out", join(folder, "many"));
  const page = await opened("many");
  const times = await page.evaluate(() => {
    const {player} = window.shoal;
    player.speed = 300;
    player.select(3);
    player.play();
    const spent = [];
    const eye = document.createElement("canvas").getContext("2d", {willReadFrequently: true});
    while (player.playing) {
      const began = performance.now();
      player.advance(1000 / 30);
      player.draw();
      eye.drawImage(player.canvas, 0, 0);
      eye.getImageData(0, 0, 1, 1);  // until it is really drawn
      spent.push(performance.now() - began);
    }
    return spent.sort((a, b) => a - b);
  });
  const at = share => times[Math.floor(share * (times.length - 1))].toFixed(1);
  console.log(`200 vehicles, ${times.length} frames: median ${at(0.5)} ms, 95 % ${at(0.95)} ms, `
              + `worst ${at(1)} ms; 30 frames per second leave 33.3 ms`);
  assert.equal((await state(page)).time, 3600);
  page.quiet();
});
