// A picture of a report: node screenshot.mjs REPORT.html PICTURE.png [TIME_S [VEHICLE [LAYER,... [WxH]]]]
//
// SHOAL_BESIDE=OTHER.html opens another run beside it; SHOAL_LOOK=dark; SHOAL_WHOLE=1 for all of the page.

import {resolve} from "node:path";
import {launch, open} from "./browser.mjs";

const [report, picture, time = "-1", vehicle = "-1", layers = "", size = "1280x860"] =
  process.argv.slice(2);
const [width, height] = size.split("x").map(Number);
const browser = await launch();
const page = await open(browser, resolve(report), {
  viewport: {width, height}, colorScheme: process.env.SHOAL_LOOK ?? "light"});
if (process.env.SHOAL_BESIDE) {
  await page.setInputFiles("#other-file", resolve(process.env.SHOAL_BESIDE));
  await page.waitForSelector("#other-map, #refused:not([hidden])");
}
await page.evaluate(([at, selected, shown]) => {
  const player = window.shoal?.player;
  if (!player) return;
  for (const layer of shown.split(",").filter(Boolean)) {
    document.getElementById(`layer-${layer}`).click();
  }
  player.select(Number(selected));
  player.seek(Number(at) < 0 ? player.end : Number(at));
  player.draw();
}, [time, vehicle, layers]);
await page.screenshot({path: picture, fullPage: process.env.SHOAL_WHOLE === "1"});
page.quiet();
await browser.close();
