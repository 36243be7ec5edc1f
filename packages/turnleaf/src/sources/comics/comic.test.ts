import { expect, test } from "vitest";
import { imagesIn } from "./comic.ts";

test("pages are in the natural order of their paths, without what systems leave there", () => {
  const names = [
    "Ch 10/1.jpg",
    "Ch 2/10.PNG",
    "Ch 2/9.png",
    "__MACOSX/Ch 2/._9.png",
    "Ch 2/.9.png",
    "Ch 2/Thumbs.db",
    "ComicInfo.xml",
    "cover.webp",
    "Ch 2/note.txt",
  ];
  expect(imagesIn(names)).toEqual(["Ch 2/9.png", "Ch 2/10.PNG", "Ch 10/1.jpg", "cover.webp"]);
  expect(imagesIn(["p02.jpg", "P1.jpg", "p001.jpg"])).toEqual(["p001.jpg", "P1.jpg", "p02.jpg"]);
});
