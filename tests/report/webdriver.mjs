// A headless Chromium by chromedriver's WebDriver interface (W3C), using Node's standard library only.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const ELEMENT = "element-6066-11e4-a52e-4f735466cecf"; // the key of element references, fixed by the specification

const CHROMIUM_FLAGS = [
  "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
  "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage", "--hide-scrollbars",
];

/** Starts chromedriver on a free port and resolves to { port, process }. */
function startDriver() {
  return new Promise((resolve, reject) => {
    const driver = spawn("chromedriver", ["--port=0"], { stdio: ["ignore", "pipe", "pipe"] });
    const timer = setTimeout(() => reject(new Error("chromedriver did not start within 30 s")), 30000);
    let output = "";
    driver.on("error", (error) => reject(new Error(`chromedriver cannot be run (${error.message}): install chromium-driver`)));
    driver.stdout.on("data", (chunk) => {
      output += chunk;
      const match = output.match(/on port (\d+)\./);
      if (!match) return;
      clearTimeout(timer);
      resolve({ port: Number(match[1]), process: driver });
    });
    driver.stderr.on("data", () => {});
  });
}

export class Browser {
  /** Width and height of the window in CSS pixels. */
  static async start({ width = 1400, height = 1000 } = {}) {
    const browser = new Browser();
    browser.profile = mkdtempSync(join(tmpdir(), "probegi-chromium-"));
    browser.driver = await startDriver();
    const flags = [...CHROMIUM_FLAGS, `--user-data-dir=${browser.profile}`, `--window-size=${width},${height}`];
    try {
      const answer = await browser.call("POST", "/session", {
        capabilities: {
          alwaysMatch: {
            browserName: "chrome",
            "goog:chromeOptions": { args: flags },
            "goog:loggingPrefs": { browser: "ALL", performance: "ALL" },
          },
        },
      });
      browser.session = `/session/${answer.sessionId}`;
    } catch (error) {
      await browser.stop();
      throw error;
    }
    return browser;
  }

  async call(method, path, body) {
    const response = await fetch(`http://127.0.0.1:${this.driver.port}${path}`, {
      method,
      headers: { "content-type": "application/json" },
      body: body === undefined ? undefined : JSON.stringify(body),
    });
    const { value } = await response.json();
    if (!response.ok) throw new Error(`${method} ${path}: ${value.error}: ${value.message}`);
    return value;
  }

  command(method, path, body) {
    return this.call(method, this.session + path, body);
  }

  open(url) {
    return this.command("POST", "/url", { url });
  }

  /** From here on, emulates a small screen in dark mode. */
  async emulatePhone(width = 390, height = 844) {
    const devtools = (cmd, params) => this.command("POST", "/goog/cdp/execute", { cmd, params });
    await devtools("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 2, mobile: true });
    await devtools("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: "dark" }] });
  }

  /** Runs a function's text in the page with JSON-able arguments. */
  run(script, ...args) {
    return this.command("POST", "/execute/sync", { script, args });
  }

  async find(selector) {
    const found = await this.command("POST", "/elements", { using: "css selector", value: selector });
    return found.map((reference) => reference[ELEMENT]);
  }

  reference(element) {
    return { [ELEMENT]: element };
  }

  keys(element, text) {
    return this.command("POST", `/element/${element}/value`, { text });
  }

  /** Presses at one point of an element and releases at another, both in CSS pixels from its centre. */
  drag(element, from, to, pointerType = "mouse") {
    const origin = this.reference(element);
    return this.command("POST", "/actions", {
      actions: [{
        type: "pointer", id: pointerType, parameters: { pointerType },
        actions: [
          { type: "pointerMove", duration: 0, origin, x: Math.round(from), y: 0 },
          { type: "pointerDown", button: 0 },
          { type: "pointerMove", duration: 100, origin, x: Math.round(to), y: 0 },
          { type: "pointerUp", button: 0 },
        ],
      }],
    });
  }

  /** Base64 PNG of one element, or of the window. */
  picture(element) {
    return this.command("GET", element ? `/element/${element}/screenshot` : "/screenshot");
  }

  log(type) {
    return this.command("POST", "/se/log", { type });
  }

  async stop() {
    try {
      if (this.session) await this.command("DELETE", "");
    } finally {
      const ended = new Promise((resolve) => this.driver.process.once("exit", resolve));
      this.driver.process.kill();
      await ended;
      rmSync(this.profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 200 });
    }
  }
}
