// A headless Chromium without a network, spoken to over a pipe in its DevTools protocol.
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

export const browserName = ["chromium", "chromium-browser", "google-chrome"]
  .find((name) => spawnSync(name, ["--version"], { stdio: "ignore" }).status === 0);

/** Ends the program with the code that CTest takes for a test left out where there is no Chromium. */
function needBrowser() {
  if (browserName) return;
  console.log("skipped: no Chromium on the PATH");
  process.exit(77);
}

/** Removes a folder with a profile in it: processes that outlive their browser by a moment may still write there. */
function remove(folder) {
  rmSync(folder, { recursive: true, force: true, maxRetries: 20, retryDelay: 100 });
}

/**
 * A test in a temporary folder, where there is a Chromium: runs it, prints what it complained of and ends the program.
 * @param test (folder, complain): may return a promise; `complain(text)` notes a failure
 * @param success what is printed where there was none
 */
export async function testInFolder(test, success) {
  needBrowser();
  const folder = mkdtempSync(join(tmpdir(), "blocklift-page-"));
  const failures = [];
  try {
    await test(folder, (text) => failures.push(text));
  } catch (error) {
    failures.push(String(error.stack ?? error));
  }
  remove(folder);
  for (const failure of failures) console.log(failure);
  if (failures.length === 0) console.log(success);
  process.exit(failures.length === 0 ? 0 : 1);
}

/** The same with a browser of its own: test(browser, folder, complain). */
export function testInBrowser(test, success) {
  return testInFolder(async (folder, complain) => {
    const browser = new Browser(join(folder, "profile"));
    try {
      await test(browser, folder, complain);
    } finally {
      await browser.close();
    }
  }, success);
}

class Browser {
  #waiting = new Map();
  #listeners = [];
  #last = 0;
  #rest = "";

  constructor(profile) {
    this.process = spawn(browserName, [
      "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--remote-debugging-pipe",
      "--host-resolver-rules=MAP * ~NOTFOUND", `--user-data-dir=${profile}`,
    ], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
    this.ended = new Promise((resolve) => this.process.on("exit", (code, signal) => {
      for (const { method, reject } of this.#waiting.values())
        reject(new Error(`${method}: the browser ended (${signal ?? code}) before it answered`));
      resolve();
    }));
    this.process.stdio[3].on("error", () => {});  // said by the end of the browser
    this.process.stdio[4].setEncoding("utf8");
    this.process.stdio[4].on("data", (text) => this.#take(text));
  }

  #take(text) {
    const messages = (this.#rest + text).split("\0");
    this.#rest = messages.pop();
    for (const message of messages.map((one) => JSON.parse(one))) {
      const asked = this.#waiting.get(message.id);
      this.#waiting.delete(message.id);
      if (asked && message.error) asked.reject(new Error(`${asked.method}: ${message.error.message}`));
      else if (asked) asked.resolve(message.result);
      else for (const listener of [...this.#listeners]) listener(message);
    }
  }

  send(method, params = {}, sessionId = undefined) {
    const id = ++this.#last;
    this.process.stdio[3].write(JSON.stringify({ id, method, params, sessionId }) + "\0");
    return new Promise((resolve, reject) => this.#waiting.set(id, { resolve, reject, method }));
  }

  /** Opens a page at a width, dark or light, with scripts or without, and waits until it has drawn itself. */
  async open(address, { width = 1280, dark = false, scripts = true } = {}) {
    const { targetId } = await this.send("Target.createTarget", { url: "about:blank" });
    const { sessionId } = await this.send("Target.attachToTarget", { targetId, flatten: true });
    const page = {
      send: (method, params) => this.send(method, params, sessionId),
      value: async (expression) => {
        const { result, exceptionDetails } = await page.send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
        if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
        return result.value;
      },
      /** Complains of each expression whose value is another than is due: {what: [expression, due]}. */
      expect: async (complain, expectations) => {
        for (const [what, [expression, due]] of Object.entries(expectations)) {
          const found = await page.value(expression);
          if (found !== due) complain(`${what}: ${found} instead of ${due}`);
        }
      },
      close: () => this.send("Target.closeTarget", { targetId }),
    };
    await page.send("Page.enable");
    await page.send("Emulation.setDeviceMetricsOverride", { width, height: 900, deviceScaleFactor: 1, mobile: false });
    await page.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }] });
    await page.send("Emulation.setScriptExecutionDisabled", { value: !scripts });
    const loaded = new Promise((resolve, reject) => {
      this.ended.then(() => reject(new Error(`the browser ended before it had read ${address}`)));
      const listener = (message) => {
        if (message.sessionId !== sessionId || message.method !== "Page.loadEventFired") return;
        this.#listeners.splice(this.#listeners.indexOf(listener), 1);
        resolve();
      };
      this.#listeners.push(listener);
    });
    await page.send("Page.navigate", { url: address });
    await loaded;
    if (scripts) await page.value("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 200))))");
    return page;
  }

  /** Ends the browser and waits until it has gone. */
  close() {
    this.process.kill();
    return this.ended;
  }
}
