// Opens a page in a headless Chromium and does what a list of steps says, speaking the DevTools protocol over
// a pair of pipes: no port, no other package.
//
//   node drive_page.mjs PAGE.html STEPS.json [FOLDER]  ->  JSON on stdout: { browser, results, console, requests }
//
// STEPS is a list of { eval: "JavaScript that may await" }, { key: "ArrowRight" }, { drag: [x0, y0, x1, y1], on: "canvas0" },
// { wait: "JavaScript that becomes true" }, { screenshot: "file.png", width, height, dark }. Exit 3: no browser.
//
// The browser is the one $CHROMIUM names, chromium in PATH, or the one inside the npm package
// @sparticuz/chromium in FOLDER's node_modules (target/npm).
import { spawn, spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, renameSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [page, stepsFile, modules] = process.argv.slice(2);
const steps = JSON.parse(readFileSync(stepsFile, "utf8"));
const PATIENCE = 120_000;

async function browser() {
  const named = process.env.CHROMIUM;
  if (named) return { program: named, flags: ["--headless=new"] };
  for (const program of ["chromium", "chromium-browser", "google-chrome"]) {
    if (spawnSync(program, ["--version"], { stdio: "ignore" }).status === 0) return { program, flags: ["--headless=new"] };
  }
  const entry = modules && path.join(modules, "node_modules/@sparticuz/chromium/build/cjs/index.cjs");
  if (!entry || !existsSync(entry)) return null;
  const kept = path.join(modules, "chromium-unpacked");
  if (!existsSync(kept)) await unpack(entry, kept);
  // It brings the libraries it needs (NSS) and a font.
  process.env.LD_LIBRARY_PATH = path.join(kept, "al2023/lib");
  process.env.FONTCONFIG_PATH = path.join(kept, "fonts");
  return { program: path.join(kept, "chromium"), flags: ["--headless=shell", "--no-zygote", "--in-process-gpu"] };
}

// Unpacks the browser into a folder of its own, which takes its name when it is whole: several may be at it.
async function unpack(entry, kept) {
  const { TMPDIR: before } = process.env;
  const fresh = mkdtempSync(`${kept}-`);
  process.env.TMPDIR = fresh;
  // So it unpacks its libraries too, as it does where it was made for.
  process.env.AWS_EXECUTION_ENV ??= "AWS_Lambda_nodejs22.x";
  const loaded = createRequire(import.meta.url)(entry);
  await (loaded.default ?? loaded).executablePath();
  if (before === undefined) delete process.env.TMPDIR;
  else process.env.TMPDIR = before;
  try {
    renameSync(fresh, kept);
  } catch {
    // Another was faster.
    rmSync(fresh, { recursive: true, force: true });
  }
}

const found = await browser();
if (!found) {
  console.error("no chromium in $CHROMIUM, in PATH or in node_modules");
  process.exit(3);
}
const profile = mkdtempSync(path.join(tmpdir(), "drive-page-"));
const flags = [
  ...found.flags, "--remote-debugging-pipe", "--no-sandbox", "--disable-gpu", "--no-first-run", "--disable-dev-shm-usage",
  "--disable-background-networking", "--disable-component-update", "--disable-sync", "--hide-scrollbars",
  "--force-color-profile=srgb", `--user-data-dir=${profile}`, "about:blank",
];
const chromium = spawn(found.program, flags, { stdio: ["ignore", "ignore", "pipe", "pipe", "pipe"] });
let words = "";
chromium.stderr.on("data", (bytes) => (words = (words + bytes).slice(-4000)));
function finish(code) {
  clearTimeout(clock);
  chromium.removeAllListeners("exit");
  chromium.kill("SIGKILL");
  try {
    rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
  } catch {
    // A folder in the temporary one is nobody's loss.
  }
  process.exitCode = code;
  process.stdout.write("", () => process.exit(code));
}
function give_up(why) {
  console.error(`${why}\n${words}`);
  finish(2);
}
const clock = setTimeout(() => give_up("the browser takes too long"), PATIENCE);
chromium.on("exit", (code, signal) => give_up(`the browser ended: ${code ?? signal}`));
chromium.on("error", (fault) => give_up(`the browser does not start: ${fault}`));

let count = 0;
const waiting = new Map();
const events = [];
let rest = "";
chromium.stdio[4].on("data", (bytes) => {
  rest += bytes.toString("utf8");
  const messages = rest.split("\0");
  rest = messages.pop();
  for (const text of messages) {
    const message = JSON.parse(text);
    if (message.id) {
      const { resolve, reject } = waiting.get(message.id);
      waiting.delete(message.id);
      if (message.error) reject(new Error(JSON.stringify(message.error)));
      else resolve(message.result);
    } else {
      events.push(message);
    }
  }
});
function call(method, params = {}, sessionId) {
  const id = ++count;
  chromium.stdio[3].write(JSON.stringify({ id, method, params, sessionId }) + "\0");
  return new Promise((resolve, reject) => waiting.set(id, { resolve, reject }));
}

async function run() {
  const { product } = await call("Browser.getVersion");
  const { targetId } = await call("Target.createTarget", { url: "about:blank" });
  const { sessionId } = await call("Target.attachToTarget", { targetId, flatten: true });
  const tab = (method, params) => call(method, params, sessionId);
  for (const domain of ["Page", "Runtime", "Log", "Network"]) await tab(`${domain}.enable`);
  const size = (width, height) =>
    tab("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: false });
  await size(1400, 1000);
  await tab("Page.navigate", { url: page.startsWith("file:") ? page : pathToFileURL(page).href });
  const evaluate = async (expression) => {
    const wrapped = `(async()=>(${expression}))()`;
    const { result, exceptionDetails } =
      await tab("Runtime.evaluate", { expression: wrapped, awaitPromise: true, returnByValue: true });
    if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception?.description}`);
    return result.value;
  };
  const wait = async (expression) => {
    while (!(await evaluate(expression).catch(() => false))) await new Promise((done) => setTimeout(done, 20));
  };
  const settled = "document.documentElement.dataset.busy==='false'";
  const idle = async () => {
    // What was pressed is drawn with the next picture of the screen.
    await evaluate("new Promise(done=>requestAnimationFrame(()=>requestAnimationFrame(()=>done(1))))");
    await wait(settled);
  };
  await wait("document.readyState==='complete'");
  if (!steps.some((step) => step.plain)) await wait(settled);
  const results = [];
  for (const step of steps) {
    if (step.eval !== undefined) {
      results.push(await evaluate(step.eval));
    } else if (step.wait !== undefined) {
      await wait(step.wait);
    } else if (step.key !== undefined) {
      const key = { key: step.key, code: step.code ?? step.key, text: step.key.length === 1 ? step.key : undefined };
      await tab("Input.dispatchKeyEvent", { type: "keyDown", ...key });
      await tab("Input.dispatchKeyEvent", { type: "keyUp", ...key });
    } else if (step.drag !== undefined) {
      // Shares of an element's width and height.
      const box = await evaluate(`(b=>[b.left,b.top,b.width,b.height])(${step.on}.getBoundingClientRect())`);
      const [x0, y0, x1, y1] = step.drag.map((share, i) => box[i % 2] + share * box[2 + (i % 2)]);
      const mouse = (type, x, y, buttons) =>
        tab("Input.dispatchMouseEvent", { type, x, y, buttons, button: "left", clickCount: 1 });
      await mouse("mousePressed", x0, y0, 1);
      await mouse("mouseMoved", (x0 + x1) / 2, (y0 + y1) / 2, 1);
      await mouse("mouseMoved", x1, y1, 1);
      await mouse("mouseReleased", x1, y1, 0);
    } else if (step.screenshot !== undefined) {
      await size(step.width ?? 1400, step.height ?? 1000);
      const value = step.dark ? "dark" : "light";
      await tab("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value }] });
      await idle();
      const { data } = await tab("Page.captureScreenshot", { format: "png", captureBeyondViewport: Boolean(step.whole) });
      writeFileSync(step.screenshot, Buffer.from(data, "base64"));
    }
    if (!step.plain) await idle();
  }
  const requests = events
    .filter(({ method }) => method === "Network.requestWillBeSent")
    .map(({ params }) => params.request.url.slice(0, 80))
    .filter((url) => !url.startsWith("data:") && !url.startsWith("about:"));
  const said = events
    .filter(({ method }) => ["Runtime.consoleAPICalled", "Runtime.exceptionThrown", "Log.entryAdded"].includes(method))
    .map(({ method, params }) => {
      const { exceptionDetails: fault, entry, args } = params;
      return `${method}: ${fault?.exception?.description ?? fault?.text ?? entry?.text ?? JSON.stringify(args)}`;
    });
  console.log(JSON.stringify({ browser: product, results, console: said, requests }));
}
run().then(() => finish(0), (fault) => give_up(String(fault.stack)));
