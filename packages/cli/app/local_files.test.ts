import { expect, it } from "vitest";
import { droppedFiles, filesOfFolder, pickedFiles } from "./local_files.ts";

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

it("puts images in the natural order of their names, folder after folder", async () => {
  const folders = { "b 10": { "1.png": null }, "b 9": { "10.png": null, "9.png": null } };
  expect(await dropped({ scans: folders })).toEqual(["9.png", "10.png", "1.png"]);
  const files = ["10.png", "9.png"].map((name) => ({ name }));
  expect(pickedFiles(files as File[]).map(({ name }) => name)).toEqual(["9.png", "10.png"]);
});

it("takes of a picked folder what it takes of a dropped one", () => {
  const picked = (...paths: string[]): string[] => {
    const files = paths.map((webkitRelativePath) => ({
      webkitRelativePath,
      name: webkitRelativePath.split("/").pop(),
    }));
    return filesOfFolder(files as File[]).map((file) => file.webkitRelativePath);
  };
  expect(picked("s/10.png", "s/9.png", "s/.8.png", "s/.git/7.png", "s/notes.txt")).toEqual([
    "s/9.png",
    "s/10.png",
  ]);
  expect(picked("s/b 10/1.png", "s/b 9/2.png")).toEqual(["s/b 9/2.png", "s/b 10/1.png"]);
  expect(picked("novel/cover.jpg", "novel/novel.epub")).toEqual(["novel/novel.epub"]);
  expect(picked(`${"deep/".repeat(20)}1.png`, "top/1.png")).toEqual(["top/1.png"]);
  expect(picked("none/a.docx")).toEqual([]);
});
