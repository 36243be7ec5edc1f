import { type ChildProcess, spawn } from "node:child_process";

/** A program that runs until it is ended. */
export class Child {
  readonly process: ChildProcess;
  readonly #ended: Promise<void>;
  #output = "";
  readonly #killAtExit = (): boolean => this.process.kill("SIGKILL");

  constructor(file: string, args: readonly string[], environment: NodeJS.ProcessEnv = {}) {
    this.process = spawn(file, args, {
      env: { ...process.env, ...environment },
      stdio: ["ignore", "pipe", "pipe"],
    });
    for (const stream of [this.process.stdout, this.process.stderr]) {
      stream?.on("data", (data) => {
        this.#output += data;
      });
    }
    process.once("exit", this.#killAtExit);
    this.#ended = new Promise((resolve) => {
      this.process.once("error", () => resolve());
      this.process.once("close", () => resolve());
    });
  }

  /**
   * Resolves to the first match in what it writes.
   * Rejects if it ends before, with what it wrote.
   */
  async says(pattern: RegExp): Promise<RegExpExecArray> {
    const found = new Promise<RegExpExecArray>((resolve) => {
      const look = (): void => {
        const match = pattern.exec(this.#output);
        if (match) resolve(match);
      };
      for (const stream of [this.process.stdout, this.process.stderr]) stream?.on("data", look);
      look();
    });
    const ended = this.#ended.then(() => {
      throw new Error(`${this.process.spawnfile} ended: ${this.#output}`);
    });
    return Promise.race([found, ended]);
  }

  /** Resolves once it has ended by itself. */
  async end(): Promise<void> {
    await this.#ended;
    process.removeListener("exit", this.#killAtExit);
  }

  /** Ends it. */
  async kill(): Promise<void> {
    this.process.kill();
    await this.end();
  }
}
