/** Before every file of browser tests: the clock is the tests' own, and nothing is drawn. */

import { afterEach } from "vitest";
import { clock, installClock } from "./clock.ts";
import { drawNothing } from "./undrawn.ts";
import { countWork } from "./work.ts";

installClock();
drawNothing();
countWork();
afterEach(() => clock.run());
