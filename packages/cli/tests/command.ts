import { type ChildProcess, type SpawnOptions, spawn } from "node:child_process";
import { mkdirSync, mkdtempSync, realpathSync, rmSync, writeFileSync } from "node:fs";
import { request } from "node:http";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { findChromium } from "../../../scripts/chromium.mjs";

/** The built command. */
export const main: string = fileURLToPath(new URL("../dist/main.js", import.meta.url));

/** The result of a command that ended. */
export interface Ended {
  readonly status: number | null;
  readonly signal: NodeJS.Signals | null;
  readonly stdout: string;
  readonly stderr: string;
}

/** A command that serves. */
export interface Started {
  /** With a slash at its end. */
  readonly url: string;
  readonly port: number;
  readonly stdout: string;
  readonly stderr: () => string;
  readonly child: ChildProcess;
  stop(signal?: NodeJS.Signals): Promise<Ended>;
}

interface Running {
  readonly child: ChildProcess;
  readonly text: { stdout: string; stderr: string };
  readonly ended: Promise<Ended>;
}

function launch(
  args: readonly string[],
  environment: NodeJS.ProcessEnv = {},
  options: SpawnOptions = {},
): Running {
  const child = spawn(process.execPath, [main, ...args], {
    ...options,
    env: { ...process.env, CI: "1", ...environment },
    stdio: ["ignore", "pipe", "pipe"],
  });
  const text = { stdout: "", stderr: "" };
  child.stdout.on("data", (data) => {
    text.stdout += data;
  });
  child.stderr.on("data", (data) => {
    text.stderr += data;
  });
  const ended = new Promise<Ended>((resolve) => {
    child.on("close", (status, signal) => resolve({ status, signal, ...text }));
  });
  return { child, text, ended };
}

/**
 * Milliseconds after which a command that does not end is killed: less than a test may take, so that the
 * test says so, and more than a command takes on a machine that does ten other things as well.
 */
const patience = 100_000;

/** Runs the built command until it ends by itself, or is killed as it does not. */
export const run = (...args: string[]): Promise<Ended> =>
  launch(args, {}, { timeout: patience, killSignal: "SIGKILL" }).ended;

/**
 * Runs the built command, which draws in a Chromium, until it ends by itself.
 *
 * @param watch sees it as it begins
 */
export function runWithChromium(
  args: readonly string[],
  watch?: (child: ChildProcess) => void,
  environment: NodeJS.ProcessEnv = {},
): Promise<Ended> {
  const { child, ended } = launch(args, { CHROMIUM: findChromium(), ...environment });
  watch?.(child);
  return ended;
}

/** Milliseconds between looks at what a command has written. */
const look = 5;

/** Sends a signal to a command once a condition of what it has written holds, unless it has ended. */
export function signalOnce(
  child: ChildProcess,
  condition: () => boolean,
  signal: NodeJS.Signals,
): void {
  // biome-ignore lint/plugin: Files of another process are only seen by looking.
  const timer = setInterval(() => {
    if (!condition()) return;
    clearInterval(timer);
    child.kill(signal);
  }, look);
  child.once("close", () => clearInterval(timer));
}

/** Starts reading with the built command and waits until it serves. */
export const start = (...args: string[]): Promise<Started> => startServing("read", ...args);

/** Starts the built command and waits until it serves. */
export async function startServing(...args: string[]): Promise<Started> {
  const { child, text, ended } = launch(args);
  const url = await new Promise<string>((resolve, reject) => {
    const look = (): void => {
      const found = / at (http:\S+)\n.*Ctrl\+C/.exec(text.stdout)?.[1];
      if (found) resolve(found);
    };
    child.stdout?.on("data", look);
    ended.then(({ stderr }) => reject(new Error(`It ended: ${stderr}`)));
  });
  return {
    url,
    port: Number(new URL(url).port),
    stdout: text.stdout,
    stderr: () => text.stderr,
    child,
    stop(signal = "SIGINT") {
      child.kill(signal);
      return ended;
    },
  };
}

/** A response of the server, with its headers in lower case. */
export interface Reply {
  readonly status: number;
  readonly headers: NodeJS.Dict<string | string[]>;
  readonly body: Buffer;
}

/** Sends a request exactly as given: the path is not normalised and no header added. */
export function ask(
  port: number,
  path: string,
  options: { method?: string; headers?: Record<string, string>; body?: string } = {},
): Promise<Reply> {
  return new Promise((resolve, reject) => {
    const headers = { Host: `127.0.0.1:${port}`, ...options.headers };
    const sent = request(
      { host: "127.0.0.1", port, path, method: options.method ?? "GET", headers, agent: false },
      (response) => {
        const parts: Buffer[] = [];
        response.on("data", (part: Buffer) => parts.push(part));
        response.on("error", reject);
        response.on("end", () => {
          const { statusCode = 0, headers } = response;
          resolve({ status: statusCode, headers, body: Buffer.concat(parts) });
        });
      },
    );
    sent.on("error", reject);
    sent.end(options.body);
  });
}

/** Creates a folder of the given files, deleted when `remove` is called. */
export function folderOf(files: Record<string, string | Uint8Array>): {
  readonly path: string;
  remove(): void;
} {
  const path = realpathSync(mkdtempSync(join(tmpdir(), "turnleaf-test-")));
  for (const [name, content] of Object.entries(files)) {
    mkdirSync(dirname(join(path, name)), { recursive: true });
    writeFileSync(join(path, name), content);
  }
  return { path, remove: () => rmSync(path, { recursive: true, force: true }) };
}
