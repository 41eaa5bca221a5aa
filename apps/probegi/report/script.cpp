#include "report/assets.h"

namespace probegi::tool {

// Values behind pictures are decoded as halfFloatPlanes() encodes them; the tone map is that of
// src/kernels/screen/tone_map.h.
const std::string_view kReportScript = R"js(
"use strict";
for (const slider of document.querySelectorAll(".slider")) {
  const stage = slider.querySelector(".stage");
  const range = stage.querySelector("input");
  const [leftChoice, rightChoice] = slider.querySelectorAll("select");
  const picture = (choice) => document.getElementById(choice.value);

  function showPictures() {
    const sides = [["left", leftChoice, ".tag.a"], ["right", rightChoice, ".tag.b"]];
    for (const [side, choice, tag] of sides) {
      const image = stage.querySelector("img." + side);
      image.src = picture(choice).src;
      image.alt = picture(choice).alt;
      stage.querySelector(tag).textContent = choice.selectedOptions[0].textContent;
    }
    showSplit();
  }

  function showSplit() {
    stage.style.setProperty("--split", range.value + "%");
    range.setAttribute("aria-valuetext",
      Math.round(range.value) + " % " + leftChoice.selectedOptions[0].textContent + ", the rest " +
      rightChoice.selectedOptions[0].textContent);
  }

  function follow(event) {
    const box = stage.getBoundingClientRect();
    range.value = 100 * (event.clientX - box.left) / box.width;
    showSplit();
  }

  stage.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    stage.setPointerCapture(event.pointerId);
    follow(event);
    range.focus({ preventScroll: true, focusVisible: false });
    event.preventDefault();
  });
  stage.addEventListener("pointermove", (event) => {
    if (stage.hasPointerCapture(event.pointerId)) follow(event);
  });
  range.addEventListener("input", showSplit);
  leftChoice.addEventListener("change", showPictures);
  rightChoice.addEventListener("change", showPictures);
  slider.show = showPictures;
  showPictures();
}

const kHalves = Float32Array.from({ length: 0x8000 }, (_, bits) => {
  const exponent = bits >> 10, mantissa = bits & 1023;
  return exponent === 0 ? mantissa * 2 ** -24 : (1 + mantissa / 1024) * 2 ** (exponent - 15);
});
const kDisplay = Uint8ClampedArray.from({ length: 4097 }, (_, i) => {
  const linear = i / 4096;
  return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055);
});

function pixelsOf(image) {
  const canvas = document.createElement("canvas");
  canvas.width = image.naturalWidth;
  canvas.height = image.naturalHeight;
  const context = canvas.getContext("2d", { willReadFrequently: true });
  context.drawImage(image, 0, 0);
  return context.getImageData(0, 0, canvas.width, canvas.height).data;
}

/** The values behind a picture, three per pixel, row by row; decoded on first use. */
function valuesOf(image) {
  image.values ??= (async () => {
    const packed = new Image();
    packed.src = image.dataset.values;
    await packed.decode();
    const bytes = pixelsOf(packed), half = bytes.length / 2;
    const values = new Float32Array(half / 4 * 3);
    for (let i = 0, o = 0; i < half; i += 4)
      for (let c = 0; c < 3; ++c) values[o++] = kHalves[bytes[i + c] << 8 | bytes[half + i + c]];
    return values;
  })();
  return image.values;
}

function filmic(v) {
  const start = 0.6, room = 1 - start, peak = Math.max(v[0], v[1], v[2]);
  if (peak <= start) return;
  const mapped = 1 - room * Math.exp((start - peak) / room);
  const white = 1 - 1 / (1 + 0.15 * (peak - mapped));
  for (let c = 0; c < 3; ++c) v[c] = v[c] * mapped / peak * (1 - white) + mapped * white;
}

/** The picture at a different exposure, as a URL. */
async function exposed(image, exposure, shoulder) {
  const values = await valuesOf(image), v = [0, 0, 0];
  const canvas = document.createElement("canvas");
  canvas.width = image.naturalWidth;
  canvas.height = image.naturalHeight;
  const context = canvas.getContext("2d"), shown = context.createImageData(canvas.width, canvas.height);
  for (let i = 0, o = 0; i < values.length; i += 3, o += 4) {
    for (let c = 0; c < 3; ++c) v[c] = values[i + c] * exposure;
    if (shoulder) filmic(v);
    for (let c = 0; c < 3; ++c) shown.data[o + c] = kDisplay[Math.min(4096, Math.round(4096 * v[c]))];
    shown.data[o + 3] = 255;
  }
  context.putImageData(shown, 0, 0);
  return new Promise((resolve) => canvas.toBlob((blob) => resolve(URL.createObjectURL(blob))));
}

for (const view of document.querySelectorAll(".view")) {
  const bar = view.querySelector(".exposure");
  if (!bar) continue;
  const [range, output, reset] = bar.querySelectorAll("input, output, button");
  const made = Number(view.dataset.exposure), shoulder = view.dataset.filmic === "1";
  const lights = [...view.querySelectorAll("img[data-light]")].filter((image) => image.dataset.values);
  let working = false, wanted = 0;

  async function apply() {
    if (working) return;
    working = true;
    for (let done = null; done !== wanted;) {
      done = wanted;
      for (const image of lights) {
        image.made ??= image.src;
        const before = image.src;
        image.src = done === 0 ? image.made : await exposed(image, made * 2 ** done, shoulder);
        if (before.startsWith("blob:")) URL.revokeObjectURL(before);
        if (wanted !== done) break;
      }
      for (const slider of view.querySelectorAll(".slider")) slider.show();
    }
    working = false;
    view.dataset.shown = wanted;
  }

  function tell() {
    wanted = Number(range.value);
    const stops = wanted === 0 ? "as made" : (wanted > 0 ? "+" : "\u2212") + Math.abs(wanted).toFixed(1) + " stops";
    output.textContent = "\u00d7 " + Number((made * 2 ** wanted).toPrecision(3)) + " (" + stops + ")";
  }

  range.addEventListener("input", () => { tell(); apply(); });
  reset.addEventListener("click", () => { range.value = 0; tell(); apply(); });
  tell();
}

const dialog = document.getElementById("pixels");
const canvas = dialog.querySelector("canvas");
const says = dialog.querySelector("output");
const kQuiet = says.textContent;
let open = null;

const titleOf = (image) => image.closest("figure").querySelector("strong").textContent.replace(/\.$/, "");

function zoom(factor) {
  canvas.style.width = canvas.width * factor + "px";
  canvas.style.height = canvas.height * factor + "px";
}

const number = (value) => Number(value.toPrecision(3)).toString();

/** "2.31 1.02 0.4" for a colour, one number for a grey. */
function reading(image, values, x, y) {
  const at = 3 * (y * image.naturalWidth + x), v = [...values.subarray(at, at + 3)];
  return (v[0] === v[1] && v[1] === v[2] ? number(v[0]) : v.map(number).join(" ")) + " " + image.dataset.unit;
}

async function point(event) {
  const image = open, box = canvas.getBoundingClientRect();
  const x = Math.min(canvas.width - 1, Math.max(0, Math.floor((event.clientX - box.left) / box.width * canvas.width)));
  const y = Math.min(canvas.height - 1, Math.max(0, Math.floor((event.clientY - box.top) / box.height * canvas.height)));
  const view = image.closest(".view");
  const others = view ? [...view.querySelectorAll("figure img[data-values]")].filter((other) => other !== image) : [];
  const lines = image.dataset.values ? ["x " + x + ", y " + y + ": " + reading(image, await valuesOf(image), x, y)] : [];
  const rest = [];
  for (const other of others)
    rest.push(titleOf(other) + " " + reading(other, await valuesOf(other), x, y));
  if (open === image) says.textContent = [...lines, rest.join("  \u00b7  ")].join("\n");
}

for (const button of document.querySelectorAll(".zoom"))
  button.addEventListener("click", () => {
    open = button.querySelector("img");
    canvas.width = open.naturalWidth;
    canvas.height = open.naturalHeight;
    canvas.getContext("2d").drawImage(open, 0, 0);
    dialog.querySelector("strong").textContent = titleOf(open);
    says.textContent = kQuiet;
    zoom(1);
    dialog.showModal();
  });
for (const button of dialog.querySelectorAll("[data-zoom]"))
  button.addEventListener("click", () => zoom(Number(button.dataset.zoom)));
dialog.querySelector("[data-close]").addEventListener("click", () => dialog.close());
canvas.addEventListener("pointermove", point);
canvas.addEventListener("pointerdown", point);
)js";

}  // namespace probegi::tool
