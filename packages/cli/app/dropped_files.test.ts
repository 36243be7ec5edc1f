import { expect, it } from "vitest";
import { droppedFiles } from "./dropped_files.ts";

type Tree = { readonly [name: string]: Tree | null };

/** Returns an entry as a browser gives it: a folder's come two at a time, until there are none. */
function entryOf(name: string, tree: Tree | null): unknown {
  if (tree === null) {
    const file = (resolve: (file: unknown) => void): void => resolve({ name });
    return { name, isFile: true, isDirectory: false, file };
  }
  const createReader = () => {
    const left = Object.entries(tree).map(([name, inner]) => entryOf(name, inner));
    return { readEntries: (resolve: (part: unknown) => void) => resolve(left.splice(0, 2)) };
  };
  return { name, isFile: false, isDirectory: true, createReader };
}

async function dropped(tree: Tree): Promise<string[]> {
  const items = Object.entries(tree).map(([name, inner]) => ({
    webkitGetAsEntry: () => entryOf(name, inner),
  }));
  const files = Object.keys(tree).map((name) => ({ name }));
  const found = await droppedFiles({ files, items } as unknown as DataTransfer);
  return found.map(({ name }) => name);
}

it("takes files as they are", async () => {
  expect(await dropped({ "a.pdf": null, "b.docx": null })).toEqual(["a.pdf", "b.docx"]);
});

it("takes a folder's images, those of folders in it too, without what is hidden or no image", async () => {
  const scans = { "1.png": null, "2.JPG": null, ".3.png": null, "notes.txt": null };
  expect(await dropped({ scans: { ...scans, more: { "4.webp": null } } })).toEqual([
    "1.png",
    "2.JPG",
    "4.webp",
  ]);
});

it("takes the one book of a folder, and none of several if there are images", async () => {
  expect(await dropped({ novel: { "cover.jpg": null, "novel.epub": null } })).toEqual([
    "novel.epub",
  ]);
  const others = ["hero.rar", "hero.7z", "novel.mobi", "novel.AZW3", "novel.azw", "novel.fb2"];
  for (const name of ["hero.cbr", "hero.CB7", ...others]) {
    expect(await dropped({ comic: { "cover.jpg": null, [name]: null } })).toEqual([name]);
  }
  expect(await dropped({ two: { "a.pdf": null, "b.pdf": null, "1.png": null } })).toEqual([
    "1.png",
  ]);
  expect(await dropped({ none: { "a.docx": null } })).toEqual([]);
});

it("looks at a bounded number of entries, and no deeper than eight folders", async () => {
  const many = Object.fromEntries(Array.from({ length: 30_000 }, (_, k) => [`${k}.png`, null]));
  expect((await dropped({ many })).length).toBeLessThan(20_001);
  let deep: Tree = { "deep.png": null };
  for (let k = 0; k < 20; k++) deep = { folder: deep };
  expect(await dropped({ deep, "top.png": null })).toEqual(["top.png"]);
});
