/** A page of the site: what surrounds its text. */
import { posix } from "node:path";

/** Returns text as it stands in HTML and in its attributes. */
export function escapeHtml(text) {
  const entities = { "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" };
  return text.replace(/[&<>"]/g, (letter) => entities[letter]);
}

/** Returns the address of one file of the site as another names it. */
export function relativeTo(from, to) {
  return posix.relative(posix.dirname(from), to) || posix.basename(to);
}

/**
 * Returns a whole page.
 *
 * @param place where it lies in the site
 * @param groups the navigation: groups of titles with the file in the site that each names
 */
export function pageOf({ place, title, body, groups }) {
  const address = (to) => escapeHtml(relativeTo(place, to));
  const item = ([name, to]) => {
    const here = to === place ? ' aria-current="page"' : "";
    return `<li><a href="${address(to)}"${here}>${escapeHtml(name)}</a></li>`;
  };
  const lists = Object.entries(groups).map(([name, group]) => {
    return `<p>${escapeHtml(name)}</p>\n<ul>${Object.entries(group).map(item).join("\n")}</ul>`;
  });
  return `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>${escapeHtml(title)} – Turnleaf</title>
<link rel="icon" href="data:,">
<link rel="stylesheet" href="${address("site.css")}">
</head>
<body>
<a class="skip" href="#text">To the text</a>
<header><a href="${address("index.html")}">Turnleaf</a></header>
<main id="text">
${body}
</main>
<nav aria-label="Pages">
${lists.join("\n")}
</nav>
</body>
</html>
`;
}
