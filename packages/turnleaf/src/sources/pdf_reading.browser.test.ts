import { afterEach, describe, expect, it } from "vitest";
import { limits } from "./limits.ts";
import { openSource } from "./open.ts";
import type { PagePicture, PageSource, TextRun } from "./page_source.ts";
import { type TinyPdf, tinyPdf } from "./tiny_pdf.ts";

const never = new AbortController().signal;
const opened: PageSource[] = [];
const fonts = "/Font << /F1 << /Type /Font /Subtype /Type1 /BaseFont /Helvetica >> >>";

afterEach(() => {
  for (const source of opened.splice(0)) source.close();
});

async function open(pdf: TinyPdf & { annotations?: readonly string[] }): Promise<PageSource> {
  const source = await openSource(new File([tinyPdf(pdf)], "book.pdf"));
  opened.push(source);
  return source;
}

/** Text on a page of 200 x 300 points, from the lower left corner. */
const say = (text: string, matrix: string): string => `BT /F1 20 Tf ${matrix} Tm (${text}) Tj ET\n`;

const textOf = async (content: string, more: Partial<TinyPdf> = {}): Promise<readonly TextRun[]> =>
  await (await open({ pages: [content], resources: fonts, ...more })).text!(0, never);

/** Returns the box of the ink on the picture, in fractions of it. */
function inkOf(picture: PagePicture): { left: number; top: number; right: number; bottom: number } {
  const { width, height } = picture;
  const context = new OffscreenCanvas(width, height).getContext("2d")!;
  context.drawImage(picture, 0, 0);
  const { data } = context.getImageData(0, 0, width, height);
  const ink = { left: 1, top: 1, right: 0, bottom: 0 };
  for (let y = 0; y < height; y++) {
    for (let x = 0; x < width; x++) {
      if (data[4 * (y * width + x)] > 128) continue;
      ink.left = Math.min(ink.left, x / width);
      ink.right = Math.max(ink.right, (x + 1) / width);
      ink.top = Math.min(ink.top, y / height);
      ink.bottom = Math.max(ink.bottom, (y + 1) / height);
    }
  }
  return ink;
}

describe("the text of a PDF's page", () => {
  it("is there where its font says that letters have no width", async () => {
    const widths = `/FirstChar 32 /LastChar 126 /Widths [${"0 ".repeat(95)}]`;
    const font = `/Font << /F1 << /Type /Font /Subtype /Type1 /BaseFont /Helvetica ${widths} >> >>`;
    const [run] = await textOf(say("Ishmael", "1 0 0 1 20 250"), { resources: font });
    expect(run).toMatchObject({ text: "Ishmael", x: 20, width: 70 });
  });

  it("comes in lines with words, where the ink is", async () => {
    const content = say("Call me", "1 0 0 1 20 250") + say("Ishmael.", "1 0 0 1 20 220");
    const source = await open({ pages: [content], resources: fonts });
    const runs = await source.text!(0, never);
    expect(runs.map(({ text, end }) => [text.trim(), end])).toEqual([
      ["Call me", true],
      ["Ishmael.", false],
    ]);
    const ink = inkOf(await source.draw(0, 800, never));
    const [first, second] = runs;
    expect(Math.abs(first.x - 200 * ink.left)).toBeLessThan(2);
    expect(Math.abs(second.x + second.width - 200 * ink.right)).toBeLessThan(2);
    // The box holds the letters and little more.
    expect(first.y).toBeLessThan(300 * ink.top + 1);
    expect(first.y).toBeGreaterThan(300 * ink.top - 8);
    expect(second.y + second.height).toBeGreaterThan(300 * ink.bottom);
    expect(second.y + second.height).toBeLessThan(300 * ink.bottom + 8);
    expect(first.angle).toBe(0);
  });

  it("is without layers that are off, of the page and of forms on it", async () => {
    const group = (name: string): string => `<< /Type /OCG /Name (${name}) >>`;
    const word = (text: string, y: number): string => say(text, `1 0 0 1 20 ${y}`);
    const marked = (layer: string, content: string): string => `/OC /${layer} BDC\n${content}EMC\n`;
    const hidden = word("FormOff", 100);
    const form = `<< /Type /XObject /Subtype /Form /BBox [0 0 200 300] /OC 11 0 R /Resources << ${fonts} >> /Length ${hidden.length} >>\nstream\n${hidden}\nendstream`;
    const content = [
      marked("On", word("On", 250)),
      marked("Off", `${word("Off", 220)}/Span << /MCID 0 >> BDC\n${word("Within", 200)}EMC\n`),
      marked("Some", word("Some", 180)),
      marked("None", word("None", 160)),
      "/Form Do\n",
      word("Behind", 60),
    ];
    const runs = await textOf(content.join(""), {
      catalog: "/OCProperties << /OCGs [10 0 R 11 0 R] /D << /OFF [11 0 R] >> >>",
      resources: `${fonts} /XObject << /Form 14 0 R >> /Properties << /On 10 0 R /Off 11 0 R /Some 12 0 R /None 13 0 R >>`,
      objects: [
        group("On"),
        group("Off"),
        "<< /Type /OCMD /OCGs [10 0 R 11 0 R] /P /AnyOn >>",
        "<< /Type /OCMD /OCGs [10 0 R 11 0 R] /P /AllOn >>",
        form,
      ],
    });
    expect(runs.map(({ text }) => text.trim())).toEqual(["On", "Some", "Behind"]);
  });

  it("is what the file says that signs stand for", async () => {
    const word = (text: string, x: number, y: number): string => say(text, `1 0 0 1 ${x} ${y}`);
    const span = (words: string, content: string): string =>
      `/Span << /ActualText ${words} >> BDC\n${content}EMC\n`;
    const content = [
      span("(fi)", word("~", 20, 250)),
      span("<FEFF00AD>", word("-", 120, 220)),
      span("()", word("***", 20, 190)),
      // Several lines, each with words of its own.
      span("(Call me Ishmael)", word("xxxxxxx", 20, 160) + word("yyyyyyy", 20, 130)),
      "/Span /Named BDC\n",
      word("z", 20, 100),
      "EMC\n",
      word("plain", 20, 70),
    ];
    const runs = await textOf(content.join(""), {
      resources: `${fonts} /Properties << /Named << /ActualText (named) >> >>`,
    });
    expect(runs.map(({ text, end }) => [text.trim(), end])).toEqual([
      ["fi", true],
      ["\u00ad", true],
      ["Call me", true],
      ["Ishmael", true],
      ["named", true],
      ["plain", false],
    ]);
    expect(runs[0].width).toBeCloseTo(0.584 * 20);
  });

  it("says where each letter stands, where it is asked to", async () => {
    // Words set far apart explicitly, as in a justified line.
    const set = (x: number, text: string): string => say(text, `1 0 0 1 ${x} 250`);
    const content = `${set(20, "iii")}${set(44, "WWW")}${say("apart", "1 0 0 1 20 200")}`;
    const source = await open({ pages: [content], resources: fonts });
    const [first, second] = await source.text!(0, never, true);
    expect(first.text.trim()).toBe("iii WWW");
    const at = (first.places?.[4] ?? 0) * first.width + first.x;
    expect(Math.abs(at - 44)).toBeLessThan(1);
    expect(first.places?.[0]).toBe(0);
    expect(second.places?.length).toBe(second.text.length);
    expect((await source.text!(0, never))[0].places).toBeUndefined();
  });

  it("may run up the page, and down a page that is turned", async () => {
    const [up] = await textOf(say("Aloft", "0 1 -1 0 100 50"));
    expect(up.angle).toBeCloseTo(-Math.PI / 2, 6);
    expect([up.x, up.y].map(Math.round)).toEqual([86, 250]);
    const turned = await open({
      pages: [say("Down", "1 0 0 1 50 200")],
      resources: `${fonts} >> /Rotate 90 /Ignored <<`,
    });
    expect(await turned.size(0)).toEqual({ width: 300, height: 200 });
    const [down] = await turned.text!(0, never);
    expect(down.angle).toBeCloseTo(Math.PI / 2, 6);
    expect(Math.abs(down.y - 50)).toBeLessThan(0.01);
  });

  it("is bounded, cleaned, and of this page alone", async () => {
    const many = Array.from({ length: limits.runs + 50 }, (_, i) =>
      say("a", `1 0 0 1 ${10 + 30 * (i % 6)} ${10 + (i % 277)}`),
    );
    expect((await textOf(many.join(""))).length).toBe(limits.runs);
    const out = say("gone", "1 0 0 1 900 900") + say("here", "1 0 0 1 20 20");
    expect((await textOf(out)).map(({ text }) => text)).toEqual(["here"]);
    const huge = say("x".repeat(limits.runLength + 999), "0.0001 0 0 1 20 20");
    for (const { text } of await textOf(huge))
      expect(text.length).toBeLessThanOrEqual(limits.runLength);
  });

  it("is stopped when aborted, and read again afterwards", async () => {
    const source = await open({ pages: [say("Call", "1 0 0 1 20 250")], resources: fonts });
    const controller = new AbortController();
    const reading = source.text!(0, controller.signal);
    controller.abort(new Error("turned on"));
    await expect(reading).rejects.toThrow("turned on");
    expect((await source.text!(0, never)).length).toBe(1);
  });
});

it("what a tagged PDF's pictures show is said", async () => {
  const source = await open({
    pages: ["/Figure << /MCID 0 >> BDC 0 0 50 50 re f EMC"],
    catalog: "/MarkInfo << /Marked true >> /StructTreeRoot 10 0 R",
    objects: [
      "<< /Type /StructTreeRoot /K 11 0 R /ParentTree << /Nums [0 [12 0 R]] >> >>",
      "<< /Type /StructElem /S /Document /P 10 0 R /K [12 0 R] >>",
      "<< /Type /StructElem /S /Figure /P 11 0 R /Pg 13 0 R /K 0 /Alt (A whale\\000) >>",
    ],
    resources: ">> /StructParents 0 /Ignored <<",
  });
  expect(await source.alt!(0, never)).toBe("A whale");
  expect(await (await open({ pages: [""] })).alt!(0, never)).toBe("");
});

describe("a PDF's links and contents", () => {
  const link = (target: string, rect = "[10 20 60 40]"): string =>
    `<< /Type /Annot /Subtype /Link /Rect ${rect} ${target} >>`;
  const annotated = (annotations: readonly string[], more: Partial<TinyPdf> = {}): TinyPdf => ({
    pages: ["", "", ""],
    resources: `>> /Annots [${annotations.join(" ")}] /Ignored <<`,
    ...more,
  });

  it("lead to pages and to the web, and nowhere else", async () => {
    const source = await open(
      annotated(
        [
          link("/Dest [2 /Fit] /Contents (The end)"),
          link("/Dest (two)"),
          link("/A << /S /URI /URI (https://example.org/a b) >>"),
          link("/A << /S /URI /URI (mailto:ahab@pequod.example) >>"),
          link("/A << /S /URI /URI (javascript:alert\\(1\\)) >>"),
          link("/A << /S /URI /URI (file:///etc/passwd) >>"),
          link("/A << /S /JavaScript /JS (app.alert\\(1\\)) >>"),
          link("/A << /S /Launch /F (calc.exe) >>"),
          link("/Dest [99 /Fit]"),
          link("/A << /S /Named /N /NextPage >>"),
          link("/Dest [1 /Fit]", "[10 20 10 20]"),
        ],
        { catalog: "/Dests << /two [1 /Fit] >>" },
      ),
    );
    const links = await source.links!(0, never);
    expect(links.map(({ to }) => to)).toEqual([
      { page: 3 },
      { page: 2 },
      { href: "https://example.org/a%20b" },
      { href: "mailto:ahab@pequod.example" },
      { page: 2 },
    ]);
    expect(links[0]).toEqual({
      x: 10,
      y: 260,
      width: 50,
      height: 20,
      title: "The end",
      to: { page: 3 },
    });
  });

  it("that lead nowhere are listed, by the words under them or what they ask for", async () => {
    const actions = [
      "/S /GoToR /F (other.pdf) /D [0 /Fit]",
      "/S /Launch /F (calc.exe)",
      "/S /JavaScript /JS (app.alert\\(1\\)) >> /Contents (Ask) /Ignored <<",
      "/S /SubmitForm /F (https://example.org/)",
      "/S /ImportData /F (a.fdf)",
      "/S /ResetForm",
      "/S /Named /N /Print",
      "/S /GoToE /T << /R /C /N (a.pdf) >>",
      "/S /Thread /D 0",
      "/S /Rendition",
      "/S /URI /URI (file:///etc/passwd)",
      "/S /GoTo /D (none)",
    ];
    const links = actions.map((action) => link(`/A << ${action} >>`));
    const named = link("/A << /S /Thread /D 0 >>", "[20 225 120 250]");
    const source = await open(
      annotated([...links, named, link("/A << /S /Named /N /PrevPage >>")], {
        pages: [say("Thread", "1 0 0 1 30 230")],
        resources: `${fonts} >> /Annots [${[...links, named].join(" ")}] /Ignored <<`,
      }),
    );
    expect(await source.links!(0, never)).toEqual([]);
    const nowhere = "a link on a page of book.pdf, leads nowhere in it.";
    expect(source.warnings).toEqual(
      [
        'other.pdf#[0,{"name":"Fit"}]',
        "calc.exe",
        "Ask",
        "–",
        "Print",
        "file:///etc/passwd",
        "Thread",
      ].map((name) => ({ code: "link", message: `${name}, ${nowhere}`, source: name, page: 1 })),
    );
  });

  it("that are hidden, or for print alone, are none", async () => {
    const flags = [2, 32, 4, 64];
    const links = flags.map((flag) => link(`/F ${flag} /Contents (${flag}) /Dest [0 /Fit]`));
    const source = await open(annotated([...links, link("/F 2 /A << /S /Thread >>")]));
    expect((await source.links!(0, never)).map(({ title }) => title)).toEqual(["4", "64"]);
    expect(source.warnings).toEqual([]);
  });

  it("are buttons of a form too, and turn pages by name", async () => {
    const button = (action: string): string =>
      `<< /Type /Annot /Subtype /Widget /FT /Btn /Ff 65536 /T (b) /TU (Go) /Rect [10 20 60 40] /A << ${action} >> >>`;
    const names = ["FirstPage", "PrevPage", "NextPage", "LastPage"];
    const source = await open(
      annotated([
        button("/S /URI /URI (https://example.org/)"),
        ...names.map((name) => button(`/S /Named /N /${name}`)),
        button("/S /ResetForm"),
      ]),
    );
    const links = await source.links!(1, never);
    expect(links.map(({ title, to }) => [title, to])).toEqual([
      ["Go", { href: "https://example.org/" }],
      ...[1, 1, 3, 3].map((page) => ["Go", { page }]),
    ]);
    expect(source.warnings?.map(({ source }) => source)).toEqual(["Go"]);
    expect((await source.links!(0, never)).map(({ to }) => to)).toEqual([
      { href: "https://example.org/" },
      ...[1, 2, 3].map((page) => ({ page })),
    ]);
  });

  it("stand in an outline with its levels", async () => {
    const source = await open({
      pages: ["", "", ""],
      catalog: "/Outlines 10 0 R",
      objects: [
        "<< /Type /Outlines /First 11 0 R /Last 13 0 R /Count 2 >>",
        "<< /Title (One\\000) /Parent 10 0 R /Dest [0 /Fit] /Next 13 0 R /First 12 0 R /Last 12 0 R >>",
        "<< /Title (Of one) /Parent 11 0 R /Dest [1 /Fit] >>",
        "<< /Title (Web) /Parent 10 0 R /A << /S /URI /URI (https://example.org/) >> /First 11 0 R >>",
      ],
    });
    expect(await source.outline!(never)).toEqual([
      { title: "One", page: 1, children: [{ title: "Of one", page: 2, children: [] }] },
      { title: "Web", page: null, href: "https://example.org/", children: [] },
    ]);
    expect(await (await open({ pages: [""] })).outline!(never)).toEqual([]);
  });

  it("lead to their page, whichever part of it they name", async () => {
    const parts = [
      "",
      "/XYZ",
      "/XYZ 0",
      "/Fit 0",
      "/FitH 1 2 3",
      "/FitR 0 0",
      "/Other",
      "(Fit)",
      "null 1",
    ];
    const named = "/A << /S /GoTo /D (named) >>";
    const links = [...parts.map((part) => `/Dest [2 ${part}]`), named].map((to) => link(to));
    const catalog = "/Dests << /named [2] >> /OpenAction [1]";
    const source = await open(annotated(links, { catalog }));
    const found = await source.links!(0, never);
    expect(found.map(({ to }) => to)).toEqual(links.map(() => ({ page: 3 })));
    expect(source.warnings).toEqual([]);
    expect(source.openingPage).toBe(2);
  });

  it("end at the bounds of number and depth", async () => {
    const deep = 40;
    const objects = ["<< /Type /Outlines /First 11 0 R /Last 11 0 R >>"];
    for (let k = 0; k < deep; k++) {
      objects.push(
        `<< /Title (${k}) /Parent ${10 + k} 0 R ${k + 1 < deep ? `/First ${12 + k} 0 R` : ""} >>`,
      );
    }
    const source = await open({ pages: [""], catalog: "/Outlines 10 0 R", objects });
    let depth = 0;
    for (let level = await source.outline!(never); level.length > 0; level = level[0].children)
      depth++;
    expect(depth).toBe(limits.outlineDepth);
  });
});

describe("a PDF's form", () => {
  it("says what its fields are and what they hold", async () => {
    const field = (more: string): string =>
      `<< /Type /Annot /Subtype /Widget /Rect [10 20 110 40] ${more} >>`;
    const source = await open({
      pages: [""],
      catalog: "/AcroForm << /Fields [10 0 R 11 0 R 12 0 R] >>",
      objects: [
        field("/FT /Tx /T (name) /TU (Your name) /V (Ahab) /MaxLen 12"),
        field("/FT /Btn /T (aboard) /V /Yes /AS /Yes /AP << /N << /Yes 13 0 R /Off 13 0 R >> >>"),
        field("/FT /Ch /Ff 131072 /T (ship) /Opt [[(p) (Pequod)] (Rachel)] /V (p)"),
        "<< /Length 0 /Type /XObject /Subtype /Form /BBox [0 0 1 1] >>\nstream\n\nendstream",
      ],
      resources: ">> /Annots [10 0 R 11 0 R 12 0 R] /Ignored <<",
    });
    const [name, aboard, ship] = await source.fields!(0, never);
    expect(name).toMatchObject({
      kind: "text",
      name: "name",
      title: "Your name",
      value: "Ahab",
      maxLength: 12,
    });
    expect(name).toMatchObject({ x: 10, y: 260, width: 100, height: 20, readonly: false });
    expect(aboard).toMatchObject({ kind: "check", name: "aboard", value: "Yes", on: "Yes" });
    expect(ship).toMatchObject({ kind: "choice", value: "p" });
    expect(ship.options).toEqual([
      { value: "p", label: "Pequod" },
      { value: "Rachel", label: "Rachel" },
    ]);
  });
});

describe("a filled form", () => {
  it("is drawn with what it holds, on every view of a field, and saved with it", async () => {
    const field = "/FT /Tx /T (name) /DA (/Helv 20 Tf 0 g) /Rect [20 200 180 240]";
    const source = await open({
      pages: ["", ""],
      catalog: "/AcroForm << /Fields [10 0 R] /DR << /Font << /Helv 11 0 R >> >> >>",
      objects: [
        `<< /Type /Annot /Subtype /Widget ${field} >>`,
        "<< /Type /Font /Subtype /Type1 /BaseFont /Helvetica >>",
      ],
      resources: ">> /Annots [10 0 R] /Ignored <<",
    });
    expect(inkOf(await source.draw(0, 200, never)).right).toBe(0);
    await source.fields!(0, never);
    source.fill!(0, "name", "AHAB");
    expect(inkOf(await source.draw(0, 200, never)).right).toBeGreaterThan(0.2);
    expect((await source.fields!(1, never))[0].value).toBe("AHAB");
    expect(inkOf(await source.draw(1, 200, never)).right).toBeGreaterThan(0.2);
    const saved = await openSource(new File([await source.file!()], "saved.pdf"));
    opened.push(saved);
    expect((await saved.fields!(0, never))[0].value).toBe("AHAB");
  });
});

describe("a PDF", () => {
  it("draws a part of a page as sharp as asked", async () => {
    const source = await open({ pages: ["0 0 1 rg 100 150 50 75 re f"] });
    const region = { x: 0.5, y: 0.25, width: 0.5, height: 0.5 };
    const picture = await source.draw(0, 400, never, region);
    expect([picture.width, picture.height]).toEqual([400, 600]);
    const ink = inkOf(picture);
    expect(ink).toEqual({ left: 0, top: 0, right: 0.5, bottom: 0.5 });
  });

  it("gives its own file back, and says what its owner allows", async () => {
    const bytes = tinyPdf({ pages: [""] });
    const source = await openSource(new File([bytes], "book.pdf"));
    opened.push(source);
    const file = await source.file!();
    expect(file.type).toBe("application/pdf");
    expect(new Uint8Array(await file.arrayBuffer())).toEqual(bytes);
    expect(source.allows).toEqual({ print: true, copy: true });
  });

  it("is not printed or copied from against its owner's will", async () => {
    // Written by pdfkit with an owner's password and no permissions.
    const source = await openSource(new File([fromBase64(guarded)], "guarded.pdf"));
    opened.push(source);
    expect(source.allows).toEqual({ print: false, copy: false });
    expect(inkOf(await source.draw(0, 100, never)).left).toBeCloseTo(0.05, 1);
  });
});

const fromBase64 = (text: string): Uint8Array<ArrayBuffer> =>
  Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));

const guarded =
  "JVBERi0xLjcKJf////8KOCAwIG9iago8PAovVHlwZSAvUGFnZQovUGFyZW50IDEgMCBSCi9NZWRpYUJveCBbMCAwIDIwMCAzMDBdCi9Db250ZW50cyA2IDAgUgovUmVzb3VyY2VzIDcgMCBSCi9Vc2VyVW5pdCAxCj4+CmVuZG9iago3IDAgb2JqCjw8Ci9Qcm9jU2V0IFsvUERGIC9UZXh0IC9JbWFnZUIgL0ltYWdlQyAvSW1hZ2VJXQovQ29sb3JTcGFjZSA8PAo+Pgo+PgplbmRvYmoKNiAwIG9iago8PAovTGVuZ3RoIDY0Ci9GaWx0ZXIgL0ZsYXRlRGVjb2RlCj4+CnN0cmVhbQroOrcL74QLRvVTVE9ZGuPg9duMF9PuaP0oSb10vf/sQ57Z9Li9qrA6rOZAwZ65OnLCwf7vVsVFAGSEjCWMcVV7CmVuZHN0cmVhbQplbmRvYmoKMTAgMCBvYmoKKBACk4jalk2QHwJ53bn7IHEqC1xiT1pWO6b+vnyRetqpXHIpCmVuZG9iagoxMSAwIG9iagooIp08+dBqXFxcKNAnZwdPAjqP+sKhakyFT5CGQhpTi6fSrSkKZW5kb2JqCjEyIDAgb2JqCij2TH32zTxihFYDXG5a4kzhupAt1IHrJkxeoINPudsvbubZbFb5Wv7x8dLawpRgMeCZKQplbmRvYmoKOSAwIG9iago8PAovUHJvZHVjZXIgMTAgMCBSCi9DcmVhdG9yIDExIDAgUgovQ3JlYXRpb25EYXRlIDEyIDAgUgo+PgplbmRvYmoKNCAwIG9iago8PAo+PgplbmRvYmoKMTMgMCBvYmoKPDwKL2xlbmd0aCA2NzMKL1R5cGUgL01ldGFkYXRhCi9TdWJ0eXBlIC9YTUwKL0xlbmd0aCA3MDQKPj4Kc3RyZWFtCm81xg2rfW2ycgV6T6QRYE0kIbsvdwCZgpKwTSe1JyWkhSIrTH0GMSGUGf16hlNuIJUmuWl17CoOQo56mIQXR1ZSbzhRk+p9xB+oP98WLUBensa6GMv3krqDz2I1dc+hidP1JX1rLOtYKfnlHRPZXvS+tygF8uhHMmZY1b0aXKKbsDWvUumGo24WffjoQWcmCOAK6K/W5i6o4CTba15JpGDWNirON2p9gw95P0F5Qe9Qcl4IpdZRBqpKA2zWOO2OOB/4ziu4yQ7GhVDk1V2nc4Hn8JBey0O3kvjlrqYlzgeefW+wV09tQ5b55rA7CJ1F9r5DhrwtAjk26T2vfsc9csfo0zTO/OjToyFtO1AUgRLL+ZaHEDq7RsTAMfwT+Qfm3nFGAtxyvV1lkkIwDGSHVm4ro0wD8f+nfRpLpZOcCSgKjx0Nb3F5JuJ9FhAUS1uX2qdNSMQUKhIq/671uLyPPodcyFFltU8CmR5uaqUjqtPLS0Lofrdh6DcLUf+lk9l5WaChn9HRYEH68OqhV+Qx6fKXkQqYoqiuRLsGNvxP14baGFI1elG0UhmQv4dcFVM7JH1zqo1n1yQty3weI3vEkic17Bt3ygg/e7GR4/BmdVwFa9lZKVNXmDfTDABRrmt+8uk1aS0t/geKpctAwqy1YZLeGH99dv/z1SHvNAc8XKLu1w/TmkBe+WF0qHY5Gt2UcSdOk9jA6scEGPyc5ATC4yAlc0LdraMwABipqwsRLbkLh5bgYvHZHlv6S//NLdrLJdkFJDv6deqIb2MF9wYGE0MRdy4ruNYlNWzb/QytIK7Phz24bjULdBvD8vyozWm3PjNOn2YPDgcfa2SHhDyxwvSDYdd6esvBVj/KtfMyIpqTF9utY88t9ytso5Wj7UyjH2y3zUVyeV8g6N8dxjKjMCpG/BdD01Bnw/dugc1/WN3/CmVuZHN0cmVhbQplbmRvYmoKMyAwIG9iago8PAovVHlwZSAvQ2F0YWxvZwovUGFnZXMgMSAwIFIKL05hbWVzIDIgMCBSCi9NZXRhZGF0YSAxMyAwIFIKPj4KZW5kb2JqCjEgMCBvYmoKPDwKL1R5cGUgL1BhZ2VzCi9Db3VudCAxCi9LaWRzIFs4IDAgUl0KPj4KZW5kb2JqCjIgMCBvYmoKPDwKL0Rlc3RzIDw8CiAgL05hbWVzIFsKXQo+Pgo+PgplbmRvYmoKNSAwIG9iago8PAovRmlsdGVyIC9TdGFuZGFyZAovViA0Ci9MZW5ndGggMTI4Ci9DRiA8PAovU3RkQ0YgPDwKL0F1dGhFdmVudCAvRG9jT3BlbgovQ0ZNIC9BRVNWMgovTGVuZ3RoIDE2Cj4+Cj4+Ci9TdG1GIC9TdGRDRgovU3RyRiAvU3RkQ0YKL1IgNAovTyA8ZTc3MzMwNWU5N2NjOGU5NTIyYzU3ZTM0YWVkYTYyZThmYjg4YjdiODQwZTE1ODlhOTY2Zjc3NTE3ZmU1NGNlMD4KL1UgPDA5NWE1YmIwOGM2OTExNTA0ODI1OGJkYTQ2ZjUxZTg5MDAwMDAwMDAwMDAwMDAwMDAwMDAwMDAwMDAwMDAwMDA+Ci9QIC0zOTA0Cj4+CmVuZG9iagp4cmVmCjAgMTQKMDAwMDAwMDAwMCA2NTUzNSBmIAowMDAwMDAxNDk4IDAwMDAwIG4gCjAwMDAwMDE1NTUgMDAwMDAgbiAKMDAwMDAwMTQxOSAwMDAwMCBuIAowMDAwMDAwNjAwIDAwMDAwIG4gCjAwMDAwMDE2MDIgMDAwMDAgbiAKMDAwMDAwMDIxNiAwMDAwMCBuIAowMDAwMDAwMTMxIDAwMDAwIG4gCjAwMDAwMDAwMTUgMDAwMDAgbiAKMDAwMDAwMDUyNSAwMDAwMCBuIAowMDAwMDAwMzUxIDAwMDAwIG4gCjAwMDAwMDA0MDQgMDAwMDAgbiAKMDAwMDAwMDQ1NyAwMDAwMCBuIAowMDAwMDAwNjIxIDAwMDAwIG4gCnRyYWlsZXIKPDwKL1NpemUgMTQKL1Jvb3QgMyAwIFIKL0luZm8gOSAwIFIKL0lEIFs8YWJhYzA1YzAyZjEyNjkzOTc4YzE5ZjI3OWJlNDA0MzA+IDxhYmFjMDVjMDJmMTI2OTM5NzhjMTlmMjc5YmU0MDQzMD5dCi9FbmNyeXB0IDUgMCBSCj4+CnN0YXJ0eHJlZgoxOTA0CiUlRU9GCg==";
