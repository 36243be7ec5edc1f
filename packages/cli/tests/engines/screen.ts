import { findXvfb } from "../../../../scripts/browsers.mjs";
import { Child } from "./child.ts";

/** A screen that exists only in memory, with OpenGL in software. */
export interface Screen {
  /** Environment of the programs that should use it. */
  readonly environment: NodeJS.ProcessEnv;
  close(): Promise<void>;
}

/** Starts a screen. */
export async function startScreen(): Promise<Screen> {
  const size = "800x600x24";
  const server = new Child(findXvfb() ?? "Xvfb", [
    ...["-displayfd", "1", "-screen", "0", size, "-nolisten", "tcp"],
  ]);
  const [, display] = await server.says(/^(\d+)\n/m);
  return {
    environment: {
      DISPLAY: `:${display}`,
      GDK_BACKEND: "x11",
      // No graphics card, so that the pictures are the same everywhere.
      LIBGL_ALWAYS_SOFTWARE: "1",
    },
    close: () => server.kill(),
  };
}
