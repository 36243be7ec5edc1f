/** What a reader gets who chooses nothing: one length of lines where words are divided, and no gaps elsewhere. */

import { afterEach, expect, test } from "vitest";
import { alignText, alignUnsaid } from "./align_text.ts";

const body = document.createElement("div");
document.body.append(body);

afterEach(() => body.replaceChildren());

const markup = `
  <p id="plain" lang="en">Said nothing</p>
  <p id="foreign" lang="xx">A language that is not divided</p>
  <p id="left" lang="en" style="text-align: left">The book says left</p>
  <p id="centred" lang="en" style="text-align: center">Centred</p>
  <p id="justified" lang="en" style="text-align: justify">Of one length</p>
  <p id="undivided" lang="en" style="text-align: justify; hyphens: none">Not divided</p>
  <p id="verse" lang="en" style="white-space: pre-wrap">Verse</p>
  <table><tr><td><p id="cell" lang="en">Cell</p></td></tr></table>
  <h1 lang="en"><span>Title</span></h1>`;

const isEnglish = (element: Element): boolean => element.getAttribute("lang") === "en";

/** Returns how each paragraph is set: its alignment, and whether its words are divided. */
function set(
  align: "" | "justify" | "start",
  hyphens: "" | "auto" | "none",
): Record<string, string> {
  body.innerHTML = markup;
  body.removeAttribute("style");
  alignText(body, align);
  alignUnsaid(body, { align, hyphens }, isEnglish);
  return Object.fromEntries(
    [...body.querySelectorAll("[id]")].map((element) => {
      const { textAlign, hyphens } = getComputedStyle(element);
      return [element.id, `${textAlign} ${hyphens}`];
    }),
  );
}

test("paragraphs of which nobody says how are of one length and divided where the browser knows the language", () => {
  expect(set("", "")).toEqual({
    plain: "justify auto",
    foreign: "start manual",
    left: "left manual",
    centred: "center manual",
    justified: "justify auto",
    undivided: "justify none",
    verse: "start manual",
    cell: "start manual",
  });
});

test("what the reader chooses holds", () => {
  expect(set("start", "").plain).toBe("start manual");
  expect(set("start", "").justified).toBe("start manual");
  expect(set("justify", "")).toMatchObject({ plain: "justify auto", foreign: "justify manual" });
  expect(set("", "none")).toMatchObject({ plain: "start manual", justified: "justify manual" });
});
