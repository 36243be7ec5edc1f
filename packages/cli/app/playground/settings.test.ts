import { expect, test } from "vitest";
import page from "../../../../docs/playground.md?raw";
import { BadLink, bounds, firstSettings, readLink, type Settings, writeLink } from "./settings.ts";
import { textsFor } from "./texts.ts";
import { variantNames } from "./variants.ts";

test("the first settings need no link, and no link is the first settings", () => {
  expect(writeLink(firstSettings)).toBe("");
  expect(readLink("")).toEqual(firstSettings);
  expect(readLink("#")).toEqual(firstSettings);
});

test("a link carries every setting at either end of its bounds", () => {
  for (const end of [0, -1] as const) {
    const settings = Object.fromEntries(
      Object.entries(bounds).map(([name, bound]) => {
        if (bound.kind === "switch") return [name, end === 0];
        if (bound.kind === "creases") {
          return [name, end === 0 ? "62.0.100.27.150" : "50.0.50.100.-175_100.0.60.100.0"];
        }
        if (bound.kind === "range") return [name, end === 0 ? bound.least : bound.most];
        return [name, bound.of.at(end)];
      }),
    ) as unknown as Settings;
    expect(settings).not.toEqual(firstSettings);
    expect(readLink(`#${writeLink(settings)}`)).toEqual(settings);
  }
});

test("every value that a slider can have comes back as it was", () => {
  for (const [name, bound] of Object.entries(bounds)) {
    if (bound.kind !== "range") continue;
    const count = Math.round((bound.most - bound.least) / bound.by);
    for (let k = 0; k <= count; k += Math.ceil(count / 97)) {
      const value = Number((bound.least + k * bound.by).toFixed(4));
      const settings = { ...firstSettings, [name]: value };
      expect(readLink(writeLink(settings)), `${name} ${value}`).toEqual(settings);
    }
  }
});

test("a link with anything that is no setting within its bounds is ignored whole", () => {
  const faultOf = (link: string) => {
    try {
      readLink(link);
    } catch (error) {
      if (error instanceof BadLink) return error.setting;
    }
    return "none";
  };
  expect(faultOf("gravity=1e9")).toBe("gravity");
  expect(faultOf("gravity=-3")).toBe("gravity");
  expect(faultOf("gravity=26")).toBe("gravity");
  expect(faultOf("gravity=NaN")).toBe("gravity");
  expect(faultOf("gravity=")).toBe("gravity");
  expect(faultOf("air=Infinity")).toBe("air");
  expect(faultOf("air=0x10")).toBe("air");
  expect(faultOf("left=__proto__")).toBe("left");
  expect(faultOf("left=constructor")).toBe("left");
  expect(faultOf("right=<img src=x onerror=alert(1)>")).toBe("right");
  expect(faultOf("steps=61")).toBe("steps");
  expect(faultOf("strain=true")).toBe("strain");
  expect(faultOf("creases=")).toBe("creases");
  expect(faultOf("creases=62.0.101.27.150")).toBe("creases");
  expect(faultOf("creases=62.0.62.0.150")).toBe("creases");
  expect(faultOf("creases=62.0.100.27.181")).toBe("creases");
  expect(faultOf("creases=62.0.100.27")).toBe("creases");
  expect(faultOf(`creases=${Array(5).fill("62.0.100.27.150").join("_")}`)).toBe("creases");
  expect(faultOf("__proto__=1")).toBe(null);
  expect(faultOf("toString=1")).toBe(null);
  expect(faultOf("angle=10&angle=20")).toBe(null);
  expect(faultOf(`angle=${"1".repeat(4000)}`)).toBe(null);
  expect(faultOf("angle=10&gravity=oops")).toBe("gravity");
  expect(faultOf("angle=10&gravity=3")).toBe("none");
});

test("docs/playground.md lists every model as the page does", () => {
  const [, list = ""] = /^- \*\*Models\.\*\* (.*)$/m.exec(page) ?? [];
  const { texts } = textsFor("en");
  for (const name of variantNames) expect(list).toContain(texts.variants[name]);
});
