// What the tests of pages share: Debian's Chromium, and pages that may not complain.

import assert from "node:assert/strict";
import {execFileSync} from "node:child_process";
import {mkdtempSync, rmSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {chromium} from "playwright-core";

export const SHOAL = process.env.SHOAL;

export function workFolder() {
  const folder = mkdtempSync(join(tmpdir(), "shoal-page-"));
  process.on("exit", () => rmSync(folder, {recursive: true, force: true}));
  return folder;
}

export function shoal(...words) {
  return execFileSync(SHOAL, words, {encoding: "utf8", maxBuffer: 1 << 26});
}

export function launch() {
  return chromium.launch({
    executablePath: process.env.SHOAL_CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-gpu", "--disable-background-networking",
           "--disable-component-update", "--disable-sync", "--no-first-run"],
  });
}

/** Opens a page of the disk. What it says on the console, throws, or asks the network for fails the
    test that calls `page.quiet()`. */
export async function open(browser, file, options = {}) {
  const context = await browser.newContext({viewport: {width: 1280, height: 900}, ...options});
  const page = await context.newPage();
  const complaints = [];
  page.on("console", message => complaints.push(`console: ${message.text()}`));
  page.on("pageerror", error => complaints.push(`error: ${error.message}`));
  page.on("request", request => {
    if (!/^(file|blob|data):/.test(request.url())) complaints.push(`network: ${request.url()}`);
  });
  await page.goto(`file://${file}`);
  page.quiet = () => assert.deepEqual(complaints, []);
  return page;
}
