// Opens a report in a headless browser and uses it as a reader would. Usage: node report_page_test.mjs REPORT.html
import assert from "node:assert/strict";
import { existsSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { Browser } from "./webdriver.mjs";

const RIGHT_ARROW = "\uE014";
const END = "\uE010";

const split = (browser, stage) =>
  browser.run("return parseFloat(getComputedStyle(arguments[0]).getPropertyValue('--split'))", browser.reference(stage));

/** Where the upper picture visibly begins, in percent of the width. */
const shownSplit = (browser, stage) =>
  browser.run(
    `const box = arguments[0].getBoundingClientRect();
     const bar = arguments[0].querySelector(".bar").getBoundingClientRect();
     const clip = getComputedStyle(arguments[0].querySelector(".right")).clipPath;
     return { bar: 100 * (bar.left + bar.width / 2 - box.left) / box.width, clip };`,
    browser.reference(stage));

async function checkPictures(browser) {
  const pictures = await browser.run(
    `return [...document.images].map((i) => ({ alt: i.alt, width: i.naturalWidth, source: i.src.slice(0, 22) }))`);
  assert.ok(pictures.length >= 4, `expected pictures, found ${pictures.length}`);
  for (const picture of pictures) {
    assert.ok(picture.width > 0, `a picture did not decode: ${picture.alt}`);
    assert.ok(picture.alt.length > 0, "a picture has no alternative text");
    assert.equal(picture.source, "data:image/png;base64,");
  }
}

async function checkDefaults(browser) {
  const pairs = await browser.run(
    `return [...document.querySelectorAll(".slider")].map((s) =>
       [...s.querySelectorAll("select")].map((c) => c.selectedOptions[0].textContent))`);
  assert.deepEqual(pairs.slice(0, 2), [["No GI", "Field"], ["Field", "Reference"]]);
}

async function checkPointer(browser, stage, pointerType) {
  const { width } = await browser.command("GET", `/element/${stage}/rect`);
  await browser.drag(stage, 0, -width / 4, pointerType);
  const left = await shownSplit(browser, stage);
  const leftPicture = await browser.picture(stage);
  await browser.drag(stage, -width / 4, width / 4, pointerType);
  const right = await shownSplit(browser, stage);
  const rightPicture = await browser.picture(stage);
  assert.ok(Math.abs(left.bar - 25) < 1.5, `${pointerType}: the line is at ${left.bar} % and not at 25 %`);
  assert.ok(Math.abs(right.bar - 75) < 1.5, `${pointerType}: the line is at ${right.bar} % and not at 75 %`);
  assert.notEqual(left.clip, right.clip, "the upper picture is cut at the same place");
  assert.notEqual(leftPicture, rightPicture, "what is on the screen did not change");
}

async function checkKeyboard(browser, stage) {
  const range = await browser.run("return arguments[0].querySelector('input')", browser.reference(stage));
  const element = Object.values(range)[0];
  const before = await split(browser, stage);
  await browser.keys(element, RIGHT_ARROW);
  assert.ok((await split(browser, stage)) > before, "the right arrow key does not move the line");
  await browser.keys(element, END);
  assert.equal(await split(browser, stage), 100);
  const spoken = await browser.run("return arguments[0].getAttribute('aria-valuetext')", range);
  assert.match(spoken, /^100 % /);
}

async function checkChoice(browser, slider) {
  const shown = await browser.run(
    `const choice = arguments[0].querySelectorAll("select")[1];
     const other = [...choice.options].find((o) => !o.selected && o.textContent === "Leaking field");
     choice.value = other.value;
     choice.dispatchEvent(new Event("change"));
     const image = arguments[0].querySelector("img.right");
     return { same: image.src === document.getElementById(other.value).src,
              tag: arguments[0].querySelector(".tag.b").textContent };`,
    browser.reference(slider));
  assert.ok(shown.same, "choosing another picture does not show it");
  assert.equal(shown.tag, "Leaking field");
}

async function checkVerdict(browser) {
  const verdicts = await browser.run(
    `return [...document.querySelectorAll(".verdict")].map((v) => ({ kind: v.className, text: v.textContent }))`);
  assert.equal(verdicts.length, 2);
  for (const verdict of verdicts) {
    assert.match(verdict.kind, /^verdict (matches|differs|noisy|leaks)$/);
    assert.match(verdict.text, /^(Matches|Differs|Reference too noisy|Leaks here)/);
  }
}

/** Runs the text of a function that returns a promise in the page, and waits for it. */
const later = (browser, script, ...args) =>
  browser.command("POST", "/execute/async", { script: `const done = arguments[arguments.length - 1];
    (async () => { ${script} })().then(done, (error) => done("failed: " + error));`, args });

/** The values behind a picture, shown at its original exposure, are the picture without its dither. */
async function checkValues(browser) {
  const apart = await later(browser, `
    const image = document.querySelector("img[data-light]"), view = image.closest(".view");
    const made = pixelsOf(image);
    const again = new Image();
    again.src = await exposed(image, Number(view.dataset.exposure), view.dataset.filmic === "1");
    await again.decode();
    const shown = pixelsOf(again);
    let worst = 0;
    for (let i = 0; i < made.length; ++i) worst = Math.max(worst, Math.abs(made[i] - shown[i]));
    return { worst, size: [made.length, shown.length] };`);
  assert.equal(apart.size?.[0], apart.size?.[1], JSON.stringify(apart));
  assert.ok(apart.worst <= 2, `values and picture are ${apart.worst} steps apart`);
}

/** Two stops up quadruples the light; pictures and sliders follow, and can be reset. */
async function checkExposure(browser) {
  const light = `const image = document.querySelectorAll("figure img[data-light]")[3];
    await image.decode();
    const bytes = pixelsOf(image);
    let sum = 0;
    for (let i = 0; i < bytes.length; i += 4) sum += bytes[i] + bytes[i + 1] + bytes[i + 2];
    const slider = document.querySelectorAll(".slider")[1].querySelector("img.right");
    return { sum, same: slider.src === image.src, source: image.src.slice(0, 5),
      told: document.querySelector(".exposure output").textContent };`;
  const move = (stops) => later(browser, `
    const view = document.querySelector(".view"), range = view.querySelector(".exposure input");
    range.value = arguments[0];
    range.dispatchEvent(new Event("input"));
    while (view.dataset.shown !== range.value) await new Promise((r) => setTimeout(r, 20));
    return true;`.replace("arguments[0]", String(stops)));
  const before = await later(browser, light);
  assert.equal(await move(2), true);
  const brighter = await later(browser, light);
  assert.ok(brighter.sum > 1.2 * before.sum, `two stops made ${before.sum} ${brighter.sum}`);
  assert.ok(brighter.same, "the slider shows the picture as it was");
  assert.equal(brighter.source, "blob:");
  assert.match(brighter.told, /\+2\.0 stops/);
  assert.equal(await move(0), true);
  const after = await later(browser, light);
  assert.deepEqual(after, before);
}

async function checkFullSize(browser) {
  const [button] = await browser.find("figure button.zoom");
  await browser.command("POST", `/element/${button}/click`, {});
  const [canvas] = await browser.find("#pixels canvas");
  await browser.drag(canvas, 2, 3);
  const says = await later(browser, `
    const output = document.querySelector("#pixels output");
    for (let i = 0; i < 100 && !/^x /.test(output.textContent); ++i) await new Promise((r) => setTimeout(r, 20));
    return { text: output.textContent, open: document.getElementById("pixels").open };`);
  assert.ok(says.open, "a click does not open the picture");
  assert.match(says.text, /^x \d+, y \d+: [0-9.e+-]+( [0-9.e+-]+ [0-9.e+-]+)? W\/sr\/m/);
  assert.match(says.text, /Reference [0-9]/);
  assert.match(says.text, /Leak map [0-9.]+ times/);
  const [twice] = await browser.find("#pixels [data-zoom='2']");
  await browser.command("POST", `/element/${twice}/click`, {});
  const wide = await browser.run(`const c = document.querySelector("#pixels canvas");
    return c.getBoundingClientRect().width / c.width`);
  assert.equal(wide, 2);
  const [close] = await browser.find("#pixels [data-close]");
  await browser.command("POST", `/element/${close}/click`, {});
  assert.equal(await browser.run("return document.getElementById('pixels').open"), false);
}

async function checkFiles(browser) {
  const links = await browser.run(`return [...document.querySelectorAll("figcaption a")].map((a) => a.getAttribute("href"))`);
  assert.equal(links.length % 4, 0);
  assert.ok(links.length >= 8);
  for (const link of links) assert.ok(existsSync(join(dirname(resolve(file)), link)), `${link} is not beside the page`);
}

async function checkAccessibility(browser) {
  const unlabelled = await browser.run(
    `return [...document.querySelectorAll("input, select")].filter((c) => !c.labels.length && !c.ariaLabel).length`);
  assert.equal(unlabelled, 0, "a control has no label");
  const ids = await browser.run("return [...document.querySelectorAll('[id]')].map((e) => e.id)");
  assert.equal(new Set(ids).size, ids.length, "an id occurs twice");
}

async function checkQuiet(browser, url) {
  const messages = (await browser.log("browser")).filter((entry) => entry.level !== "DEBUG" && entry.level !== "INFO");
  assert.deepEqual(messages, [], "the console has messages");
  const requests = (await browser.log("performance"))
    .map((entry) => JSON.parse(entry.message).message)
    .filter((message) => message.method === "Network.requestWillBeSent")
    .map((message) => message.params.request.url)
    .filter((address) => address !== url && !/^(data|blob):/.test(address));
  assert.deepEqual(requests, [], "the page asks for something outside itself");
}

/** The check for requests must be able to fail: one to another site is seen, and the page's policy blocks it. */
async function checkWatch(browser) {
  await browser.run("new Image().src = 'http://127.0.0.1:9/elsewhere.png'");
  const messages = await browser.log("browser");
  assert.ok(messages.some((entry) => entry.message.includes("Content Security Policy")), "nobody stops requests");
}

async function checkPhone(browser) {
  const page = "return getComputedStyle(document.body).backgroundColor";
  const bright = await browser.run(page);
  await browser.emulatePhone();
  assert.notEqual(await browser.run(page), bright, "the dark colour scheme is not followed");
  const layout = await browser.run("return { content: document.documentElement.scrollWidth, window: innerWidth }");
  assert.ok(layout.content <= layout.window, `the page is ${layout.content} wide in a window of ${layout.window}`);
}

const file = process.argv[2];
if (!file) throw new Error("usage: node report_page_test.mjs REPORT.html");
const url = pathToFileURL(resolve(file)).href;
const browser = await Browser.start();
try {
  await browser.open("about:blank");
  await browser.log("performance"); // the browser's own start page does not count
  await browser.open(url);
  await checkPictures(browser);
  await checkDefaults(browser);
  await checkVerdict(browser);
  await checkFiles(browser);
  const [slider] = await browser.find(".slider");
  const [stage] = await browser.find(".slider .stage");
  await checkPointer(browser, stage, "mouse");
  await checkPointer(browser, stage, "touch");
  await checkKeyboard(browser, stage);
  await checkChoice(browser, slider);
  await checkValues(browser);
  await checkExposure(browser);
  await checkFullSize(browser);
  await checkAccessibility(browser);
  await checkPhone(browser);
  await checkQuiet(browser, url);
  await checkWatch(browser);
} finally {
  await browser.stop();
}
console.log(`${file}: verdict, pictures, sliders, exposure, values, keys, labels, console and requests are as they should be`);
