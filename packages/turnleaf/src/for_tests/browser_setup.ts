/** Before every file of browser tests: the clock is the tests' own, and nothing is drawn. */

import { afterEach } from "vitest";
import { clock, installClock } from "./clock.ts";
import { drawNothing } from "./undrawn.ts";

installClock();
drawNothing();
afterEach(() => clock.run());
