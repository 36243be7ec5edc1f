/**
 * page-flip's global `St.PageFlip`, for a plain script tag. It is there at once; `<turnleaf-book>`,
 * which is a module, comes from the file beside this one, and commands wait for it.
 */

import { PageFlip } from "./page_flip.ts";

void import("../standalone.ts");

Reflect.set(globalThis, "St", { PageFlip });
