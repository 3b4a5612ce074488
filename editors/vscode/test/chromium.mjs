// A headless Chromium, spoken to over pipes in the DevTools protocol: JSON messages, each closed by a zero byte.

import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

/** As long as software rendering on a busy machine may take. */
const PATIENCE_MS = 120_000;

export const pause = (ms) => new Promise((done) => setTimeout(done, ms));

export class Chromium {
  static async start(command, [width, height]) {
    const browser = new Chromium();
    browser.profile = mkdtempSync(join(tmpdir(), "chromium-"));
    browser.child = spawn(command, [
      "--headless=new", "--remote-debugging-pipe", "--no-sandbox", "--no-first-run", "--use-gl=angle", "--use-angle=swiftshader",
      "--enable-unsafe-swiftshader", "--disable-dev-shm-usage", `--user-data-dir=${browser.profile}`, "about:blank",
    ], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    Object.assign(browser, { last: 0, waiting: new Map(), contexts: new Map() });
    browser.listen(browser.child.stdio[4]);
    const { targetId } = await browser.call("Target.createTarget", { url: "about:blank" });
    browser.session = (await browser.call("Target.attachToTarget", { targetId, flatten: true })).sessionId;
    for (const domain of ["Page", "Runtime"]) await browser.call(`${domain}.enable`);
    await browser.resize([width, height]);
    return browser;
  }

  listen(output) {
    let rest = "";
    output.setEncoding("utf8");
    output.on("data", (chunk) => {
      const messages = (rest + chunk).split("\0");
      rest = messages.pop();
      messages.forEach((message) => this.take(JSON.parse(message)));
    });
  }

  take({ id, method, params, result, error }) {
    if (method === "Runtime.executionContextCreated") this.contexts.set(params.context.id, params.context);
    if (method === "Runtime.executionContextDestroyed") this.contexts.delete(params.executionContextId);
    const [done, failed] = this.waiting.get(id) ?? [];
    this.waiting.delete(id);
    if (error) failed?.(new Error(JSON.stringify(error)));
    else done?.(result);
  }

  call(method, params = {}) {
    const id = ++this.last, message = { id, method, params, ...(this.session && { sessionId: this.session }) };
    this.child.stdio[3].write(`${JSON.stringify(message)}\0`);
    return new Promise((done, failed) => this.waiting.set(id, [done, failed]));
  }

  resize([width, height]) {
    return this.call("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
  }

  /** The value of an expression in the page, or in one of its frames. */
  async value(expression, contextId) {
    const asked = { expression, returnByValue: true, awaitPromise: true, ...(contextId && { contextId }) };
    const { result, exceptionDetails } = await this.call("Runtime.evaluate", asked);
    if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception?.description}`);
    return result.value;
  }

  /** Waits until an expression is true and returns its value. */
  async wait(expression, contextId) {
    for (const until = Date.now() + PATIENCE_MS; ; await pause(100)) {
      const value = await this.value(expression, contextId).catch(() => undefined);
      if (value) return value;
      if (Date.now() > until) throw new Error(`never true: ${expression}`);
    }
  }

  /** Waits for a frame in which an expression is true. */
  async frame(expression) {
    for (const until = Date.now() + PATIENCE_MS; ; await pause(200)) {
      for (const id of this.contexts.keys()) {
        if (await this.value(expression, id).catch(() => false)) return id;
      }
      if (Date.now() > until) throw new Error(`no frame with ${expression}`);
    }
  }

  /** Presses a key; `modifiers`: 2 is control, 8 is shift. */
  async press(key, code, modifiers = 0) {
    const place = key.length === 1 ? `Key${key.toUpperCase()}` : key;
    for (const type of ["rawKeyDown", "keyUp"]) {
      await this.call("Input.dispatchKeyEvent", { type, key, code: place, windowsVirtualKeyCode: code, modifiers });
    }
  }

  /** Clicks into the middle of an element that an expression names. */
  async click(element) {
    const [x, y] = await this.value(`(() => { const box = (${element}).getBoundingClientRect();
      return [box.left + box.width / 2, box.top + box.height / 2]; })()`);
    for (const type of ["mouseMoved", "mousePressed", "mouseReleased"]) {
      await this.call("Input.dispatchMouseEvent", { type, x, y, button: type === "mouseMoved" ? "none" : "left", clickCount: 1 });
    }
  }

  type(text) { return this.call("Input.insertText", { text }); }

  async picture(path) {
    const { data } = await this.call("Page.captureScreenshot", { format: "png" });
    writeFileSync(path, Buffer.from(data, "base64"));
  }

  async end() {
    this.child.kill();
    await new Promise((done) => this.child.once("exit", done));
    rmSync(this.profile, { recursive: true, force: true, maxRetries: 5 });
  }
}
