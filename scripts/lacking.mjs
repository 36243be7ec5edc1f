/** What the oldest supported browsers do not have, by docs/browsers.md and MDN's browser-compat-data. */
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";

// 20 MB: a module of it would be read by vite first, which takes seconds.
const data = createRequire(import.meta.url)("@mdn/browser-compat-data");

/** The browsers of the table in docs/browsers.md by name, each with its oldest supported version. */
export function oldestBrowsers() {
  const text = readFileSync(join(import.meta.dirname, "../docs/browsers.md"), "utf8");
  const rows = [...text.matchAll(/^\| (Chrome|Edge|Firefox|Safari)\b[^|]*\| ([\d.]+)/gm)];
  return rows.map(([, name, version]) => ({ name, version }));
}

/**
 * The JavaScript built-ins and web interfaces that a browser does not have, such as "Float16Array" or
 * "Map.getOrInsert". A member may belong to the constructor or to its prototype.
 *
 * @param name "Chrome", "Edge", "Firefox" or "Safari"
 * @param version its version, such as "17.4"
 */
export function lacking({ name, version }) {
  const isLacking = ({ __compat }) =>
    __compat && !isIn(__compat.support[name.toLowerCase()], version);
  const missing = [];
  for (const group of [data.javascript.builtins, data.api]) {
    for (const [object, members] of Object.entries(group)) {
      if (isLacking(members)) missing.push(object);
      for (const [key, member] of Object.entries(members)) {
        const property = key.replace(/_static$/, "");
        // Names with another underscore are of events, parameters and behaviours.
        const isProperty = /^[A-Za-z]\w*$/.test(property) && !property.includes("_");
        if (isProperty && property !== object && isLacking(member))
          missing.push(`${object}.${property}`);
      }
    }
  }
  return missing;
}

/** Whether a version has what `support` describes, without a flag. */
function isIn(support, version) {
  return [support ?? []].flat().some(({ version_added, version_removed, flags }) => {
    if (flags || !version_added || version_added === "preview") return false;
    if (isLater(version_added, version)) return false;
    return !version_removed || isLater(version_removed, version);
  });
}

/** Whether a version, such as "17.4", is later than another. */
function isLater(version, other) {
  const [a, b] = [version, other].map((text) => text.replace("≤", "").split(".").map(Number));
  const major = a[0] - b[0];
  return major === 0 ? (a[1] ?? 0) > (b[1] ?? 0) : major > 0;
}
