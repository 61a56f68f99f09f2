// The report of a study in a real browser.

import assert from "node:assert/strict";
import {after, before, test} from "node:test";
import {existsSync, mkdirSync, writeFileSync} from "node:fs";
import {join} from "node:path";
import {launch, open, shoal, workFolder} from "./browser.mjs";

const folder = workFolder();
const report = join(folder, "out", "report.html");
let browser;

const STUDY = `title = "two <b>behaviours</b> & a </script>"
claims = "claims.toml"
scenario = "construction_square"
replications = 3
set = { trial.duration_s = 300 }
[[factor]]
name = "behaviour"
key = "behaviour.kind"
values = ["rigid_registration", "pairwise_referencing"]
[[table]]
name = "energy"
caption = "Energy & more"
rows = ["behaviour"]
measures = ["energy_mean_wh", "quality_final_m"]
[[table]]
name = "against_time"
columns = ["behaviour"]
series = ["quality"]
every = 10
`;
const CLAIMS = `[[claim]]
section = "1"
says = "Rigid registration spends less than 0 Wh"
where = { behaviour = "rigid_registration" }
measure = "energy_mean_wh"
test = { kind = "between", between = { at_least = -2, at_most = -1 } }
[claim.cause]
says = "energy cannot be < 0"
measure = "energy_mean_wh"
where = { behaviour = "rigid_registration" }
test = { kind = "each_between", each_between = { at_least = 0 } }
[[claim]]
section = "2"
says = "Rigid registration spends something"
where = { behaviour = "rigid_registration" }
measure = "energy_mean_wh"
test = { kind = "between", between = { at_least = 0, at_most = 100 } }
`;

before(async () => {
  writeFileSync(join(folder, "study.toml"), STUDY);
  writeFileSync(join(folder, "claims.toml"), CLAIMS);
  shoal("sweep", join(folder, "study.toml"), "--no-figures", "--out", join(folder, "out"));
  mkdirSync(join(folder, "out", "figures"));
  writeFileSync(join(folder, "out", "figures", "energy_curve.svg"),
                '<svg xmlns="http://www.w3.org/2000/svg" width="80" height="40"><path d="M0 0L9 9"/></svg>');
  shoal("report", join(folder, "out"));
  browser = await launch();
});
after(() => browser.close());

test("shows tables, claims, figures and what ran it", async () => {
  const page = await open(browser, report);
  assert.equal(await page.textContent("h1"), "two <b>behaviours</b> & a </script>");
  assert.equal(await page.textContent("caption"), "Energy & more");
  assert.equal(await page.locator("#tables table").count(), 2);
  const rows = await page.locator("#tables table").first().locator("tbody tr").count();
  assert.equal(rows, 2);
  assert.equal(await page.locator("#claims tr").count(), 2);
  assert.match(await page.textContent("#claims"), /cause: energy cannot be < 0/);
  assert.match(await page.textContent("#counts"), /1 reproduced, 1 contradicted, 0 undecided/);
  assert.equal(await page.$eval("#figures img", image => image.naturalWidth > 0), true);
  assert.match(await page.textContent("#history"), /Commit/);
  assert.match(await page.textContent("#study"), /construction_square/);
  page.quiet();
});

test("claims can be chosen by their verdict", async () => {
  const page = await open(browser, report);
  const shown = () => page.$$eval("#claims tr", rows => rows.filter(row => !row.hidden).length);
  for (const [verdict, count] of [["reproduced", 1], ["undecided", 0], ["all", 2]]) {
    await page.selectOption("#verdicts", verdict);
    assert.equal(await shown(), count, verdict);
  }
  page.quiet();
});

test("shows every trial as a point beside mean and interval", async () => {
  const page = await open(browser, report);
  const charts = page.locator(".points");
  assert.equal(await charts.count(), 2, "a chart for each measure");
  const energy = charts.first();
  assert.equal(await energy.locator(".strip").count(), 2, "a row for each behaviour");
  assert.equal(await energy.locator("circle.trial").count(), 2 * 3);
  assert.equal(await energy.locator("line.mean").count(), 2);
  // The mean of the points is where the mean is drawn.
  const [places, mean] = await energy.locator(".strip").first().evaluate(strip => [
    [...strip.querySelectorAll("circle")].map(dot => parseFloat(dot.getAttribute("cx"))),
    parseFloat(strip.querySelector(".mean").getAttribute("x1"))]);
  assert.ok(Math.abs(places.reduce((a, b) => a + b) / places.length - mean) < 1e-6);
  assert.ok(places.every(x => x >= 0 && x <= 100));
  page.quiet();
});

/** WCAG 2.1, of two colours as [red, green, blue]. */
function contrast(...colours) {
  const [dark, light] = colours.map(colour => {
    const [r, g, b] = colour.map(c => c / 255)
      .map(c => (c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  }).sort((a, b) => a - b);
  return (light + 0.05) / (dark + 0.05);
}

test("points stand out from paper and intervals, arrows of a current from paper", async () => {
  for (const colorScheme of ["light", "dark"]) {
    const page = await open(browser, report, {colorScheme});
    const {paper, current, trial, interval, share, over} = await page.evaluate(() => {
      const channels = text => text.match(/[\d.]+/g).slice(0, 3).map(Number);
      const variable = name => {
        document.body.style.color = `var(--${name})`;
        return channels(getComputedStyle(document.body).color);
      };
      const strip = [...document.querySelectorAll(".strip")].find(
        each => each.querySelector(".interval"));
      const [line, dot] = [".interval", ".trial"].map(each => strip.querySelector(each));
      return {paper: variable("paper"), current: variable("current"),
              trial: channels(getComputedStyle(dot).fill),
              interval: channels(getComputedStyle(line).stroke),
              share: Number(getComputedStyle(line).strokeOpacity),
              over: Boolean(line.compareDocumentPosition(dot) & Node.DOCUMENT_POSITION_FOLLOWING)};
    });
    const bar = interval.map((c, k) => share * c + (1 - share) * paper[k]);
    assert.ok(over, "points are drawn over the interval");
    assert.ok(contrast(trial, bar) >= 3, `${colorScheme}: ${contrast(trial, bar)}`);
    assert.ok(contrast(trial, paper) >= 3, colorScheme);
    assert.ok(contrast(current, paper) >= 3, `${colorScheme}: ${contrast(current, paper)}`);
    page.quiet();
  }
});

test("a long table is closed, and opens by its name in the contents", async () => {
  const page = await open(browser, report);
  const isOpen = () => page.$eval('#tables details[id^="long:"]', details => details.open);
  assert.equal(await isOpen(), false);
  const [bottom, top] = await page.evaluate(() => {
    const long = document.querySelector('#tables details[id^="long:"]');
    return [long.querySelector("summary").getBoundingClientRect().bottom,
            long.nextElementSibling.getBoundingClientRect().top];
  });
  assert.ok(top >= bottom, "what stands below hides the line that opens it");
  await page.click("#contents a >> text=against time");
  assert.equal(await isOpen(), true);
  page.quiet();
});

test("a cell leads to its trials, and a table to its files", async () => {
  const page = await open(browser, report);
  await page.locator("#tables tbody tr").nth(1).locator("button.to-trials").first().click();
  assert.equal(await page.locator(".pointed").count(), 1);
  assert.match(await page.textContent(".pointed .points-label"), /pairwise/);
  const files = await page.$$eval(".files a", all => all.map(each => each.getAttribute("href")));
  assert.ok(files.includes("tables/energy.csv"), files);
  for (const file of files) assert.ok(existsSync(join(folder, "out", file)), file);
  page.quiet();
});

test("what is said of a wide table stays in sight while it is scrolled", async () => {
  const page = await open(browser, report, {viewport: {width: 375, height: 740}});
  const places = await page.$eval("#tables .scroll", box => {
    box.querySelector("table").style.minWidth = "900px";
    box.scrollLeft = 400;
    return [box.querySelector("caption span"), box.querySelector("figcaption")]
      .map(each => [each.getBoundingClientRect().left, each.getBoundingClientRect().right]);
  });
  for (const [left, right] of places) assert.ok(left >= 0 && right <= 375, `${left} to ${right}`);
  page.quiet();
});

test("fits on a phone, light and dark", async () => {
  for (const colorScheme of ["light", "dark"]) {
    const page = await open(browser, report, {viewport: {width: 375, height: 740}, colorScheme});
    const wide = await page.evaluate(() => document.scrollingElement.scrollWidth);
    assert.ok(wide <= 375, `${wide} pixels`);
    page.quiet();
  }
});
