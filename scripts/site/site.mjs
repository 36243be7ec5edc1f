/**
 * The web site of the project, made of the repository's own files: every page of docs, what
 * these lead to, and the examples as they run. Links between files become links between
 * pages; one that leads nowhere fails.
 */
import {
  cpSync,
  existsSync,
  mkdirSync,
  readdirSync,
  readFileSync,
  rmSync,
  statSync,
  writeFileSync,
} from "node:fs";
import { dirname, extname, join, posix, relative } from "node:path";
import { Marked } from "marked";
import { anchorOf } from "../headings.mjs";
import { groupsWith } from "./groups.mjs";
import { escapeHtml, pageOf, relativeTo } from "./page.mjs";

const root = join(import.meta.dirname, "../..");

/** Files and folders that the site has elsewhere than the repository. */
const moved = {
  "packages/turnleaf/dist": "turnleaf",
  "node_modules/three/build": "three",
};

/** What is copied whole: the viewer, three.js, the examples and the book that they show. */
const copied = [
  "packages/turnleaf/dist",
  "node_modules/three/build/three.module.js",
  "node_modules/three/build/three.core.js",
  "examples",
  "books/moby-dick.pdf",
];

/** Files that the site has as they are; any other is shown as text. */
const asTheyAre = /^examples\/.*\.(html|css|js)$|\.(png|webp|jpg|svg|pdf)$/;

const marked = new Marked({
  renderer: {
    heading({ tokens, depth, text }) {
      return `<h${depth} id="${anchorOf(text)}">${this.parser.parseInline(tokens)}</h${depth}>\n`;
    },
    // Wide tables scroll by themselves, not the page.
    table(token) {
      const row = (cells, tag) =>
        `<tr>${cells.map((cell) => `<${tag}${cell.align ? ` class="${cell.align}"` : ""}>${this.parser.parseInline(cell.tokens)}</${tag}>`).join("")}</tr>`;
      const body = token.rows.map((cells) => row(cells, "td")).join("\n");
      return `<div class="table" tabindex="0"><table><thead>${row(token.header, "th")}</thead><tbody>${body}</tbody></table></div>\n`;
    },
  },
});

/** Text with the site's names for what lies elsewhere in the repository. */
function renamed(text) {
  const names = Object.entries(moved);
  return names.reduce((text, [from, to]) => text.replaceAll(from, to), text);
}

/** Where the page of a file or folder of the repository, or its copy, lies in the site. */
function placeOf(file) {
  if (file.endsWith(".md")) return `${file.slice(0, -3)}.html`;
  if (statSync(join(root, file)).isDirectory()) return posix.join(file, "contents.html");
  return asTheyAre.test(file) ? file : `${file}.html`;
}

/** The title of a page of Markdown: its first heading, as plain words. */
function titleOf(markdown, file) {
  const [, heading = file] = /^# (.*)$/m.exec(markdown) ?? [];
  return heading.replace(/[`*]/g, "");
}

/** A folder as a list of what is in it. */
function listing(folder) {
  const rows = readdirSync(join(root, folder)).map((name) => {
    const file = posix.join(folder, name);
    const title = name.endsWith(".md")
      ? titleOf(readFileSync(join(root, file), "utf8"), name)
      : name;
    return `<li><a href="${escapeHtml(name)}">${escapeHtml(title)}</a></li>`;
  });
  return `<h1>${escapeHtml(folder)}</h1>\n<ul>${rows.join("\n")}</ul>`;
}

/** The text of a page made of a file or folder, with links as the file has them, and its title. */
function textOf(file) {
  if (statSync(join(root, file)).isDirectory()) return [listing(file), file];
  const text = readFileSync(join(root, file), "utf8");
  if (file.endsWith(".md")) return [marked.parse(text), titleOf(text, file)];
  return [`<h1>${escapeHtml(file)}</h1>\n<pre>${escapeHtml(text)}</pre>`, file];
}

const links = /\b(href|src)="([^"#]*)(#[^"]*)?"/g;
const isElsewhere = (address) => /^[a-z][a-z+.-]*:|^\/\//i.test(address);

class Site {
  #out;
  #groups;
  #made = new Set();
  #waiting = [];

  constructor(out) {
    this.#out = out;
    const docs = readdirSync(join(root, "docs")).filter((name) => name.endsWith(".md"));
    const files = groupsWith(docs.map((name) => `docs/${name}`));
    const placed = (group) =>
      Object.fromEntries(Object.entries(group).map(([name, file]) => [name, this.#want(file)]));
    this.#groups = Object.fromEntries(
      Object.entries(files).map(([name, group]) => [name, placed(group)]),
    );
  }

  /** Has a file or folder of the repository become a part of the site. Returns where it will lie. */
  #want(file) {
    if (!this.#made.has(file)) {
      this.#made.add(file);
      this.#waiting.push(file);
    }
    return placeOf(file);
  }

  #write(place, content) {
    const path = join(this.#out, place);
    mkdirSync(dirname(path), { recursive: true });
    writeFileSync(path, content);
  }

  make() {
    for (const file of copied) {
      cpSync(join(root, file), join(this.#out, renamed(file)), { recursive: true });
    }
    for (const name of readdirSync(join(root, "site"))) {
      cpSync(join(root, "site", name), join(this.#out, name));
    }
    this.#rename("examples");
    for (const file of this.#waiting) this.#add(file);
  }

  /** Copied pages name what lies elsewhere in the site. */
  #rename(folder) {
    for (const name of readdirSync(join(this.#out, folder))) {
      const path = join(this.#out, folder, name);
      if (![".html", ".js"].includes(extname(name))) continue;
      writeFileSync(path, renamed(readFileSync(path, "utf8")));
    }
  }

  #add(file) {
    const place = placeOf(file);
    if (existsSync(join(this.#out, place))) return;
    if (asTheyAre.test(file)) {
      this.#write(place, readFileSync(join(root, file)));
      return;
    }
    const [text, title] = textOf(file);
    const folder = statSync(join(root, file)).isDirectory() ? file : posix.dirname(file);
    const body = text.replace(links, (link, name, address, anchor = "") => {
      if (address === "" || isElsewhere(address)) return link;
      const target = posix.join(folder, decodeURI(address)).replace(/\/$/, "");
      if (!existsSync(join(root, target)))
        throw new Error(`${file} leads to ${address}: there is none.`);
      return `${name}="${escapeHtml(relativeTo(place, this.#want(target)))}${anchor}"`;
    });
    this.#write(place, pageOf({ place, title, body, groups: this.#groups }));
  }
}

function filesIn(folder) {
  return readdirSync(folder, { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => join(entry.parentPath, entry.name));
}

/** Returns a sentence for each link of the built site that leads nowhere. */
export function deadLinks(out) {
  const anchors = new Map();
  const anchorsOf = (path) => {
    if (!anchors.has(path)) {
      const found = readFileSync(path, "utf8").matchAll(/\bid="([^"]+)"/g);
      anchors.set(path, new Set([...found].map(([, id]) => id)));
    }
    return anchors.get(path);
  };
  const dead = [];
  for (const path of filesIn(out).filter((path) => path.endsWith(".html"))) {
    const text = readFileSync(path, "utf8").replace(/<pre>[\s\S]*?<\/pre>/g, "");
    for (const [, , address, anchor = ""] of text.matchAll(links)) {
      if (isElsewhere(address)) continue;
      const target = address === "" ? path : join(dirname(path), decodeURI(address.split("?")[0]));
      const fault = !existsSync(target)
        ? "there is none"
        : anchor !== "" && target.endsWith(".html") && !anchorsOf(target).has(anchor.slice(1))
          ? "it has no such heading"
          : null;
      if (fault) dead.push(`${relative(out, path)} leads to ${address}${anchor}: ${fault}.`);
    }
  }
  return dead;
}

/**
 * Makes the site in a folder, whose earlier content goes. The viewer must be built.
 *
 * Throws where a link leads nowhere, with a line for each.
 */
export function makeSite(out) {
  rmSync(out, { recursive: true, force: true });
  new Site(out).make();
  const dead = deadLinks(out);
  if (dead.length > 0) throw new Error(dead.join("\n"));
  return filesIn(out).filter((path) => path.endsWith(".html")).length;
}
