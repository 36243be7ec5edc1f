/**
 * Turnleaf for a script tag: `<script type="module" src="standalone.js">` defines `<turnleaf-book>`,
 * with three.js inside, and shows the books of links with `data-turnleaf`. The rest of the package
 * is loaded from beside it when it is needed.
 */

import "./links.ts";
import { drawWith } from "./open_viewer.ts";

export * from "./index.ts";

// The build puts three.js into what this imports (three_inside.js).
drawWith(() => import("./webgl_backend.ts"));
