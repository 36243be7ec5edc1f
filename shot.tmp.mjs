import { createServer } from "vite";
import { chromium } from "playwright-core";
import { packedFiles } from "./packages/turnleaf/packed_files.js";
import { wasmInline } from "./packages/turnleaf/wasm_inline.js";
import { chromiumArguments, findChromium } from "./scripts/chromium.mjs";
import { readFileSync } from "node:fs";
const html = `<!doctype html><style>html,body{margin:0;height:100%;background:linear-gradient(#dcd5c9,#aba294)}turnleaf-book{display:block;width:100vw;height:100vh}</style>
<script type="module">
import "/packages/turnleaf/src/index.ts";
window.page=(n,w=600,h=900,colour="#f4ead2")=>{const c=document.createElement("canvas");c.width=w;c.height=h;const p=c.getContext("2d");p.fillStyle=colour;p.fillRect(0,0,w,h);p.strokeStyle="#a33";p.lineWidth=6;p.strokeRect(30,30,w-60,h-60);p.fillStyle="#222";p.font=Math.min(w,h)/3+"px serif";p.textAlign="center";p.fillText(String(n),w/2,h/2);p.font="26px serif";for(let i=0;i<9;i++)p.fillText("Some years ago never mind how long precisely",w/2,h*.6+i*34,w-90);return{src:c.toDataURL("image/jpeg")}};
window.ready=true;
</script>`;
const server = await createServer({ root: import.meta.dirname, configFile: false, logLevel: "error", server: { port: 0, hmr: false, watch: null }, optimizeDeps: { include: ["three"] }, plugins: [wasmInline(), packedFiles(), { name: "shot", configureServer(s) { s.middlewares.use((q, r, n) => q.url.startsWith("/shot.html") ? (r.setHeader("content-type", "text/html"), r.end(html)) : q.url === "/moby.pdf" ? (r.setHeader("content-type", "application/pdf"), r.end(readFileSync("books/moby-dick.pdf"))) : n()); } }] });
await server.listen();
const url = server.resolvedUrls.local[0] + "shot.html";
const browser = await chromium.launch({ executablePath: findChromium(), args: chromiumArguments });
const shots = JSON.parse(readFileSync(process.argv[2]));
for (const s of shots) {
  if (process.argv[3] && !process.argv.slice(3).includes(s.name)) continue;
  const page = await browser.newPage({ viewport: { width: s.w ?? 900, height: s.h ?? 600 } });
  page.on("pageerror", (e) => console.log(s.name, "ERROR", e.message));
  page.on("console", (m) => { if (m.type() === "error" || m.type()==="warning") console.log(s.name, m.text().slice(0, 600)); });
  try {
  await page.goto(url);
  await page.waitForFunction(() => window.ready, null, { timeout: 60000 });
  await page.evaluate((s) => {
    const e = document.createElement("turnleaf-book");
    for (const [k, v] of Object.entries(s.attrs ?? {})) e.setAttribute(k, v);
    if (s.pdf) e.src = "/moby.pdf"; else e.pages = eval(s.pages ?? "Array.from({length:40},(_,i)=>page(i+1))");
    document.body.append(e); window.book = e;
    e.addEventListener("error", (x) => console.error("book error", x.detail.message));
  }, s);
  const settled = () => page.waitForFunction(() => window.book.settled, null, { timeout: 60000, polling: 100 });
  await settled(); await page.waitForTimeout(s.wait ?? 300); await settled();
  for (const step of s.steps ?? []) {
    if (step.js) await page.evaluate(step.js);
    if (step.drag) { const [x0, y0, x1, y1] = step.drag; const W = s.w ?? 900, H = s.h ?? 600; await page.mouse.move(x0 * W, y0 * H); await page.mouse.down(); await page.mouse.move(x1 * W, y1 * H, { steps: 10 }); await page.waitForTimeout(step.ms ?? 900); if (step.up) await page.mouse.up(); }
    if (step.ms && !step.drag) await page.waitForTimeout(step.ms);
    if (step.settled) await settled();
  }
  console.log(s.name, await page.evaluate(() => JSON.stringify([window.book.page, window.book.spread, window.book.settled])));
  await page.screenshot({ path: `/tmp/bshots/${s.name}.png` });
  } catch (e) { console.log(s.name, "FAILED", e.message.slice(0, 300)); }
  await page.close();
}
await browser.close(); await server.close(); process.exit(0);
