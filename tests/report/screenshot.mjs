// Takes screenshots of a report, for inspection. Usage: node screenshot.mjs REPORT.html DESKTOP.png PHONE.png
import { writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser } from "./webdriver.mjs";

const [file, desktop, phone] = process.argv.slice(2);
if (!phone) throw new Error("usage: node screenshot.mjs REPORT.html DESKTOP.png PHONE.png");
const browser = await Browser.start({ width: 1400, height: 3200 });
try {
  await browser.open(pathToFileURL(resolve(file)).href);
  writeFileSync(desktop, Buffer.from(await browser.picture(), "base64"));
  await browser.emulatePhone(390, 2400);
  writeFileSync(phone, Buffer.from(await browser.picture(), "base64"));
} finally {
  await browser.stop();
}
