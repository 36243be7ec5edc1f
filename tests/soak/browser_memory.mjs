/** What a whole browser holds of the machine's memory, by the kinds of its processes and by what holds it. */
import { readdirSync, readFileSync } from "node:fs";

const read = (path) => {
  try {
    return readFileSync(path, "utf8");
  } catch {
    // It has ended meanwhile.
    return "";
  }
};

/** A process and all that it started. */
function family(pid) {
  const children = new Map();
  for (const name of readdirSync("/proc")) {
    const parent = /^PPid:\s+(\d+)$/m.exec(read(`/proc/${name}/status`))?.[1];
    if (parent) children.set(parent, [...(children.get(parent) ?? []), name]);
  }
  const all = [String(pid)];
  for (const one of all) all.push(...(children.get(one) ?? []));
  return all;
}

/**
 * Megabytes by kind of process, and `all` of them, on Linux. Of what processes
 * share each has its part (PSS), so that the sum is the browser's. The
 * program's own file is left out: it never grows, and another browser on the
 * machine takes a part of it.
 */
export function memoryByProcess(pid) {
  const kinds = { all: 0 };
  for (const one of family(pid)) {
    const command = read(`/proc/${one}/cmdline`);
    // It holds what this very measuring has it collect.
    if (command.includes("TracingService")) continue;
    const rollup = read(`/proc/${one}/smaps_rollup`);
    const of = (name) => Number(new RegExp(`^${name}:\\s+(\\d+)`, "m").exec(rollup)?.[1] ?? 0);
    const megabytes = (of("Pss_Anon") + of("Pss_Shmem")) / 1024;
    const kind = /--type=([\w-]+)/.exec(command)?.[1] ?? "browser";
    kinds[kind] = (kinds[kind] ?? 0) + megabytes;
    kinds.all += megabytes;
  }
  return kinds;
}

/**
 * Megabytes of machine code that software GL (SwiftShader) has compiled, on Linux.
 * It keeps its last 1,024 routines of each kind, and those of every new context are
 * new ones to it: they grow until its caches are full. No graphics card has them.
 */
export function compiledBySoftwareGL(pid) {
  const maps = family(pid).flatMap((one) => read(`/proc/${one}/smaps`).split(/^(?=[0-9a-f]+-)/m));
  const own = maps.filter((map) => /^[^\n]*memfd:swiftshader_jit/.test(map));
  return own.reduce((sum, map) => sum + Number(/^Pss:\s+(\d+)/m.exec(map)[1]) / 1024, 0);
}

/**
 * Has a browser give back what it only keeps for reuse, as it does where the
 * machine's memory is short.
 *
 * @param session a CDP session of the browser
 */
export async function releaseCaches(session) {
  await session.send("Memory.simulatePressureNotification", { level: "critical" });
}

/** What the browser's own count of each process is made of, and that is not counted twice. */
const holders = {
  Renderer: [
    "v8",
    "blink_gc",
    "malloc",
    "partition_alloc/partitions/buffer",
    "partition_alloc/partitions/array_buffer",
    "cc",
    "canvas",
    "webgl",
  ],
  "GPU Process": ["malloc", "skia", "gpu", "shared_memory"],
};

/**
 * Megabytes by what holds them, by the browser's own count: that of its
 * processes which page and drawing are in.
 *
 * @param session a CDP session of the browser
 */
export async function memoryByHolder(session) {
  const events = [];
  const collect = ({ value }) => events.push(...value);
  session.on("Tracing.dataCollected", collect);
  const traceConfig = {
    includedCategories: ["disabled-by-default-memory-infra"],
    excludedCategories: ["*"],
    memoryDumpConfig: { triggers: [] },
  };
  await session.send("Tracing.start", { traceConfig, transferMode: "ReportEvents" });
  await session.send("Tracing.requestMemoryDump", { levelOfDetail: "detailed" });
  const complete = new Promise((resolve) => session.once("Tracing.tracingComplete", resolve));
  await session.send("Tracing.end");
  await complete;
  session.off("Tracing.dataCollected", collect);
  const named = events.filter(({ name }) => name === "process_name");
  const names = new Map(named.map(({ pid, args }) => [pid, args.name]));
  const found = {};
  for (const { ph, pid, args } of events) {
    const allocators = ph === "v" && args.dumps.allocators;
    for (const holder of (allocators && holders[names.get(pid)]) || []) {
      const bytes = Number.parseInt(allocators[holder]?.attrs?.size?.value ?? "0", 16);
      const name = `${names.get(pid)}: ${holder}`;
      found[name] = (found[name] ?? 0) + bytes / 2 ** 20;
    }
  }
  return found;
}
