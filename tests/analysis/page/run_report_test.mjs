// The report of a run in a real browser: every control does what it says.
//
//     SHOAL=build/ci/bin/shoal node --test run_report_test.mjs

import assert from "node:assert/strict";
import {readFileSync, writeFileSync} from "node:fs";
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

test("moves by itself while the time is not held", async () => {
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
                                             "targets", "range", "vehicles"]]]) {
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
  for (const id of ["beside", "look", "map", "play", "back", "on", "scrub", "speed", "closer", "farther", "fit",
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
  // Also on a map on which no arrow is longer than a few pixels.
  const scales = await page.evaluate(() => {
    const {player} = window.shoal;
    const {spacing} = player.trial.current;
    const said = [];
    const fill = CanvasRenderingContext2D.prototype.fillText;
    CanvasRenderingContext2D.prototype.fillText = function (text, ...rest) {
      if (/ m\/s$/.test(text)) said.push(text);
      fill.call(this, text, ...rest);
    };
    return [40, 4, 0.5].map(pixels => {  // between arrows
      said.length = 0;
      player.camera.scale = pixels / spacing;
      player.draw();
      return said.length;
    });
  });
  assert.deepEqual(scales, [1, 1, 0]);
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

// Two runs side by side: an assignment in a current for 7500 s, and potentials among obstacles.

/** Opens a file of the disk beside the run of a page. */
async function beside(page, file) {
  await page.setInputFiles("#other-file", file);
  await page.waitForSelector("#other-map, #refused:not([hidden])");
}

/** What is on both maps now, and how many of their pixels are not paper. */
const pictures = page => page.evaluate(() => {
  const {player} = window.shoal;
  player.draw();
  return player.maps.map(({canvas}) => {
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [canvas.width, canvas.height];
    const eye = copy.getContext("2d", {willReadFrequently: true});
    eye.drawImage(canvas, 0, 0);
    const {data} = eye.getImageData(0, 0, copy.width, copy.height);
    const paper = [1, 3, 5].map(at => parseInt(look.paper.slice(at, at + 2), 16));
    let drawn = 0;
    for (let k = 0; k < data.length; k += 4) {
      drawn += paper.some((part, c) => data[k + c] !== part);
    }
    return {url: canvas.toDataURL(), drawn, size: [canvas.width, canvas.height].join()};
  });
});

function bothDiffer(after, before, what) {
  after.forEach(({url}, map) => assert.notEqual(url, before[map].url, `${what}: map ${map}`));
}

test("another run plays beside this one by the same clock, and waits at its end", async () => {
  const page = await opened("redsea");
  page.on("filechooser", chooser => chooser.setFiles(report("clutter")));
  await page.waitForTimeout(300);  // until it listens to the browser
  await page.focus("#beside");
  await page.keyboard.press("Enter");
  await page.waitForSelector("#other-map");
  const [mine, other] = await page.evaluate(() => window.shoal.player.maps.map(({trial}) => trial.end));
  assert.equal(mine, 7500);
  assert.notEqual(other, mine);
  const longer = Math.max(mine, other);
  assert.equal(Number(await page.getAttribute("#scrub", "max")), longer);
  const captions = await page.$$eval(".caption p", all => all.map(each => each.textContent));
  assert.match(captions[0], /^redsea_square · .+ · seed \d+$/);
  assert.match(captions[1], /^potentials_clutter · .+ · seed \d+$/);

  const first = await pictures(page);
  for (const {drawn, size} of first) {
    assert.ok(drawn > 500, `${drawn} pixels`);
    assert.equal(size, first[0].size);
  }
  await page.selectOption("#speed", "600");
  await page.click("#play");
  await advance(page, 500);
  await page.click("#play");
  assert.equal((await state(page)).time, 300);
  bothDiffer(await pictures(page), first, "played");

  const ended = () => page.$$eval(".end", all => all.map(each => each.hidden ? "" : each.textContent));
  assert.deepEqual(await ended(), ["", ""]);
  const shorter = Math.min(mine, other);
  const short = other < mine ? 1 : 0;
  await page.locator("#scrub").fill(String(shorter));
  const atEnd = await pictures(page);
  await page.focus("#map");
  await page.keyboard.press("End");
  assert.equal((await state(page)).time, longer);
  const after = await pictures(page);
  assert.equal(after[short].url, atEnd[short].url);
  assert.notEqual(after[1 - short].url, atEnd[1 - short].url);
  assert.match((await ended())[short], /^Ended at \d+:\d\d:\d\d$/);
  assert.equal((await ended())[1 - short], "");
  for (const map of ["map", "other-map"]) {
    const ends = map === ["map", "other-map"][short];
    assert.match(await page.getAttribute(`#${map}`, "aria-label"), ends ? /: Ended at/ : /: At/);
  }
  assert.match(await page.textContent("#said"), /: At .*: Ended at|: Ended at .*: At/);
  page.quiet();
});

test("two maps have one view, the same layers and the same vehicle", async () => {
  const page = await opened("redsea");
  await page.evaluate(() => window.shoal.player.seek(1200));
  await beside(page, report("clutter"));
  const boxes = await page.$$eval("#layers input", all => all.map(box => box.id));
  for (const layer of ["current", "obstacles", "waypoint", "trails"]) {
    assert.ok(boxes.includes(`layer-${layer}`), layer);
  }
  const inView = await page.evaluate(() => window.shoal.player.maps.every(({trial, camera}) => {
    const {x, y} = trial.bounds();
    return x.every(east => y.every(north => {
      const [px, py] = camera.toScreen(east, north);
      return px > 0 && py > 0 && px < camera.width && py < camera.height;
    }));
  }));
  assert.ok(inView);
  const fitted = await pictures(page);
  const {scale} = await state(page);
  await page.click("#closer");
  bothDiffer(await pictures(page), fitted, "closer");
  await page.click("#fit");
  assert.equal((await state(page)).scale, scale);
  await page.locator("#other-map").hover({position: {x: 100, y: 100}});
  await page.mouse.wheel(0, -300);
  await page.waitForFunction(before => window.shoal.player.camera.scale > 1.2 * before, scale);
  const zoomed = await pictures(page);
  bothDiffer(zoomed, fitted, "wheel on the other map");
  const box = await page.locator("#other-map").boundingBox();
  await page.mouse.move(box.x + 200, box.y + 200);
  await page.mouse.down();
  await page.mouse.move(box.x + 240, box.y + 180, {steps: 3});
  await page.mouse.up();
  bothDiffer(await pictures(page), zoomed, "drag on the other map");
  await page.locator("#other-map").focus();
  await page.keyboard.press("0");
  assert.equal((await state(page)).scale, scale);

  const shown = await pictures(page);
  await page.click("#layer-vehicles");
  bothDiffer(await pictures(page), shown, "vehicles");
  await page.click("#layer-vehicles");
  const place = await page.evaluate(() => {
    const [, {trial, camera}] = window.shoal.player.maps;
    const [x, y] = camera.toScreen(...trial.position(2, 1200));
    return {x, y};
  });
  await page.locator("#other-map").click({position: place});
  const selected = (await state(page)).selected;
  assert.ok(selected >= 0);
  const [mine, other] = await page.evaluate(vehicle => window.shoal.player.maps.map(map =>
    map.trial.value("distance", vehicle, map.seen(window.shoal.player).time).toFixed(0)), selected);
  assert.ok((await page.textContent("#numbers")).includes(`Distance${mine} m`));
  assert.ok((await page.textContent("#other-numbers")).includes(`Distance${other} m`));
  page.quiet();
});

test("measures and charts hold both runs", async () => {
  const page = await opened("losses");
  await beside(page, report("clutter"));
  const rows = await page.$$eval("#measures tr", all => all.map(row =>
    [...row.children].map(cell => cell.textContent)));
  const labels = rows[0].slice(1, 3);
  assert.notEqual(labels[0], labels[1]);
  assert.deepEqual(rows[0].filter((name, k) => k === 0 || k > 2), ["Measure", "Unit", "Meaning"]);
  const summaries = ["losses", "clutter"].map(
    name => JSON.parse(readFileSync(join(folder, name, "summary.json"), "utf8")).measures);
  let compared = 0;
  for (const [name, ...values] of rows.slice(1)) {
    summaries.forEach((summary, run) => {
      const value = summary[name] ?? null;
      if (value === null) assert.equal(values[run], "–", name);
      else assert.ok(Math.abs(Number(values[run]) - value) <= 1e-3 * Math.abs(value), name);
      ++compared;
    });
  }
  assert.ok(compared > 40);
  for (const summary of summaries) {
    for (const [name, value] of Object.entries(summary)) {
      assert.ok(value === null || rows.some(row => row[0] === name), name);
    }
  }

  const charts = await page.evaluate(() => window.shoal.charts.charts.map(chart => {
    const {ctx} = chart;
    const {data} = ctx.getImageData(0, 0, ctx.canvas.width, ctx.canvas.height);
    const pixelsOf = colour => {
      const wanted = [1, 3, 5].map(at => parseInt(colour.slice(at, at + 2), 16));
      let count = 0;
      for (let k = 0; k < data.length; k += 4) {
        count += data[k + 3] > 200 && wanted.every((part, c) => Math.abs(data[k + c] - part) < 24);
      }
      return count;
    };
    return {labels: chart.series.map(each => each.label), till: chart.scales.x.max,
            pixels: [pixelsOf(look.accent), pixelsOf(look.other)]};
  }));
  const {end} = await page.evaluate(() => ({end: window.shoal.player.end}));
  const shared = charts.filter(chart => labels.every(label =>
    chart.labels.some(each => each.toLowerCase().startsWith(label.toLowerCase()))));
  assert.ok(shared.length >= 3, JSON.stringify(charts));
  for (const {pixels} of shared) assert.ok(pixels.every(count => count > 30), pixels.join());
  for (const {till} of charts) assert.equal(till, end);
  // Instants of one run are not those of the other; a legend has the last number before.
  await page.evaluate(() => window.shoal.player.seek(301));
  const legend = await page.$$eval(".chart:first-child .u-value", all => all.map(each => each.textContent));
  assert.ok(legend.every(text => text !== "–"), legend.join());
  page.quiet();
});

test("files that are no report of a run are refused in a sentence", async () => {
  const page = await opened("redsea");
  const html = readFileSync(report("clutter"), "utf8");
  const file = (name, text) => {
    writeFileSync(join(folder, name), text);
    return join(folder, name);
  };
  const holding = data => `<script type="application/json" id="data">${data}</script>`;
  shoal("run", "potentials_clutter", "--set", "trial.record_every_s=0", "--set", "trial.duration_s=600",
        "--out", join(folder, "unrecorded"));
  const before = await picture(page);
  for (const [path, sentence] of [
    [file("letter.html", "<p>Dear reader</p>"), /^letter\.html is no report of shoal\.$/],
    [file("cut.html", holding('{"title": "redsea')), /^cut\.html is no report of shoal\.$/],
    [file("study.html", holding('{"claims": {"statements": []}, "tables": []}')),
     /^study\.html is the report of a study: .*\.$/],
    [file("older.html", html.replace('"matches":', '"slots":')), /^older\.html is of an older form.*\.$/],
    [file("damaged.html", html.replace(/("mode":")[^"]{8}/, "$1")), /^damaged\.html is .*damaged.*\.$/],
    [report("unrecorded"), /^report\.html has nothing to play.*\.$/],
  ]) {
    await page.evaluate(() => { document.getElementById("refused").hidden = true; });
    await beside(page, path);
    assert.match(await page.textContent("#refused"), sentence);
    assert.equal(await page.getAttribute("#refused", "role"), "alert");
    assert.equal(await page.locator("#other-map").count(), 0);
  }
  await page.evaluate(() => { document.getElementById("refused").hidden = true; });
  assert.equal(await picture(page), before);
  await beside(page, report("clutter"));
  assert.equal(await page.locator("#refused").isVisible(), false);
  // A file that is dropped replaces the one that is open.
  const text = readFileSync(report("losses"), "utf8");
  await page.evaluate(dropped => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([dropped], "report.html"));
    document.body.dispatchEvent(new DragEvent("drop", {dataTransfer, bubbles: true, cancelable: true}));
  }, text);
  await page.waitForFunction(() => window.shoal.player.maps[1].trial.end === 1200);
  assert.equal(await page.locator("canvas[id$=map]").count(), 2);
  page.quiet();
});

test("when the other run is closed the page is as it was", async () => {
  const page = await opened("losses");
  await page.click("#closer");
  await page.evaluate(() => {
    window.shoal.player.seek(900);
    window.shoal.player.select(3);
  });
  await page.mouse.move(0, 0);
  const looks = async () => {
    await page.evaluate(() => {
      document.activeElement.blur();
      window.shoal.player.draw();
    });
    return {map: await picture(page), state: await state(page),
            label: await page.getAttribute("#map", "aria-label"),
            ...await page.evaluate(() => ({
              text: document.body.innerText,
              places: [...document.querySelectorAll("body *")].map(each => {
                const {x, y, width, height} = each.getBoundingClientRect();
                return [each.tagName, x, y, width, height].join(" ");
              }),
              charts: [...document.querySelectorAll(".chart canvas")].map(each => each.toDataURL()),
              boxes: [...document.querySelectorAll("#layers input")].map(each => each.checked)}))};
  };
  const before = await looks();
  await beside(page, report("redsea"));
  const two = await looks();
  for (const part of ["map", "label", "text", "places", "charts"]) {
    assert.notDeepEqual(two[part], before[part], part);
  }
  await page.evaluate(() => window.shoal.player.play());
  await page.evaluate(() => window.shoal.player.seek(5000));
  await page.focus("#close-other");
  await page.keyboard.press("Enter");
  assert.equal(await page.evaluate(() => document.activeElement.id), "beside");
  assert.equal((await state(page)).time, 1200);  // its own end
  await page.evaluate(() => {
    window.shoal.player.pause();
    window.shoal.player.seek(900);
  });
  await page.mouse.move(0, 0);
  const after = await looks();
  for (const part of Object.keys(before)) {
    assert.deepEqual(after[part], before[part], part);
  }
  page.quiet();
});

test("on a phone the other run is below", async () => {
  const page = await opened("redsea", {viewport: {width: 375, height: 740}, hasTouch: true,
                                       isMobile: true});
  await beside(page, report("clutter"));
  const wide = await page.evaluate(() => document.scrollingElement.scrollWidth);
  assert.ok(wide <= 375, `${wide} pixels`);
  const [mine, other] = [await page.locator("#map").boundingBox(),
                         await page.locator("#other-map").boundingBox()];
  assert.deepEqual([mine.x, mine.width, mine.height], [other.x, other.width, other.height]);
  assert.ok(other.y > mine.y + mine.height);
  for (const {drawn} of await pictures(page)) assert.ok(drawn > 500, `${drawn} pixels`);
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
