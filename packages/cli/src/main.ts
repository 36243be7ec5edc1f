#!/usr/bin/env node
import packageJson from "../package.json" with { type: "json" };
import { help, parseCommand } from "./arguments.ts";
import { playground } from "./playground.ts";
import { Problem, UsageProblem } from "./problem.ts";
import { read } from "./read/read.ts";
import { supervise } from "./supervise.ts";

async function main(args: readonly string[], signal: AbortSignal): Promise<void> {
  const command = parseCommand(args);
  if (command.name === "help") console.log(command.text.trimEnd());
  else if (command.name === "version") console.log(packageJson.version);
  else if (command.name === "film") {
    const { film } = await import("./film/film.ts");
    await film(command, signal);
  } else if (command.name === "bake") {
    const { bake } = await import("./bake/bake.ts");
    await bake(command, signal);
  } else if (command.name === "publish") {
    const { publish } = await import("./publish/publish.ts");
    await publish(command, signal);
  } else if (command.name === "playground") await playground(command, signal);
  else await read(command, signal);
}

try {
  await supervise(import.meta.url, main);
} catch (error) {
  if (error instanceof UsageProblem) {
    console.error(`${error.message}\n\n${(error.help ?? help).trimEnd()}`);
    process.exitCode = 2;
  } else if (error instanceof Problem) {
    console.error(error.message);
    process.exitCode = 1;
  } else {
    throw error;
  }
}
