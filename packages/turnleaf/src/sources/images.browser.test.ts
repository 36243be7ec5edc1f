import { afterEach, describe, expect, it, vi } from "vitest";
import { messageOf } from "./message_of.ts";
import { openSource } from "./open.ts";

const never = new AbortController().signal;

afterEach(() => {
  vi.restoreAllMocks();
});

async function image(width: number, height: number, type = "image/png"): Promise<Blob> {
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext("2d")!;
  context.fillStyle = "#00f";
  context.fillRect(0, 0, width, height);
  return await canvas.convertToBlob({ type });
}

const address = async (width: number, height: number): Promise<string> =>
  URL.createObjectURL(await image(width, height));

/** Answers every fetch with `answer`. */
function serve(answer: (url: string, init?: RequestInit) => Response | Promise<Response>): void {
  vi.spyOn(globalThis, "fetch").mockImplementation(async (input, init) =>
    answer(String(input), init),
  );
}

describe("a book of images", () => {
  it("takes addresses in order and finds sizes by itself", async () => {
    const source = await openSource([await address(40, 60), await address(50, 50)]);
    expect(source.pageCount).toBe(2);
    expect(source.kind).toBe("scan");
    expect(await source.size(0)).toEqual({ width: 40, height: 60 });
    expect(await source.size(1)).toEqual({ width: 50, height: 50 });
    expect(source.label(1)).toBe("2");
  });

  it("draws as wide as asked, and never wider than the image", async () => {
    const source = await openSource([await address(400, 600)]);
    const small = await source.draw(0, 100, never);
    expect([small.width, small.height]).toEqual([100, 150]);
    const large = await source.draw(0, 5000, never);
    expect([large.width, large.height]).toEqual([400, 600]);
  });

  it("believes the image and not what a manifest claims", async () => {
    const pages = [{ src: await address(40, 60), width: 4000, height: 1000, label: "iv" }];
    const source = await openSource({ title: "Atlas", pages });
    expect(source.title).toBe("Atlas");
    expect(source.label(0)).toBe("iv");
    expect(await source.size(0)).toEqual({ width: 4000, height: 1000 });
    const picture = await source.draw(0, 4000, never);
    expect([picture.width, picture.height]).toEqual([40, 60]);
    expect(await source.size(0)).toEqual({ width: 40, height: 60 });
  });

  it("draws a part of a page, and no sharper than the image is", async () => {
    const canvas = new OffscreenCanvas(100, 200);
    const pen = canvas.getContext("2d")!;
    pen.fillStyle = "#f00";
    pen.fillRect(50, 100, 50, 100);
    const source = await openSource(
      new File([await canvas.convertToBlob()], "page.png", { type: "image/png" }),
    );
    const region = { x: 0.5, y: 0.5, width: 0.25, height: 0.5 };
    const part = (await source.draw(0, 10, never, region)) as ImageBitmap;
    expect([part.width, part.height]).toEqual([10, 40]);
    pen.drawImage(part, 0, 0);
    expect([...pen.getImageData(5, 2, 1, 1).data]).toEqual([255, 0, 0, 255]);
    expect((await source.draw(0, 900, never, region)).width).toBe(25);
    expect((await source.file!()).type).toBe("image/png");
  });

  it("tells text and links in its image's own pixels", async () => {
    const box = { x: 400, y: 100, width: 400, height: 50 };
    const said = { text: [{ ...box, text: "Call" }], links: [{ ...box, page: 1 }], alt: "A whale" };
    const pages = [{ src: await address(40, 60), width: 4000, height: 1000, ...said }];
    const source = await openSource({ title: "Atlas", outline: [{ title: "A", page: 1 }], pages });
    expect((await source.text!(0, never))[0]).toMatchObject(box);
    await source.draw(0, 40, never);
    const scaled = { x: 4, y: 6, width: 4, height: 3 };
    expect((await source.text!(0, never))[0]).toMatchObject(scaled);
    expect((await source.links!(0, never))[0]).toMatchObject({ ...scaled, to: { page: 1 } });
    expect(await source.alt!(0, never)).toBe("A whale");
    expect(await source.outline!(never)).toEqual([{ title: "A", page: 1, children: [] }]);
  });

  it.each(["image/png", "image/jpeg", "image/webp"])("opens one %s as a page", async (type) => {
    const source = await openSource(new File([await image(30, 20, type)], "page"));
    expect(await source.size(0)).toEqual({ width: 30, height: 20 });
    expect(source.title).toBe("page");
  });

  it("opens a manifest from its address, after redirects too", async () => {
    const png = await image(10, 10);
    serve((url) => {
      if (url.endsWith(".png")) return new Response(png);
      const answer = new Response('{"title": "Far", "pages": ["1.png"]}');
      Object.defineProperty(answer, "url", { value: "https://b.example/deep/book.json" });
      return answer;
    });
    const source = await openSource("https://a.example/book");
    await source.draw(0, 5, never);
    const asked = vi.mocked(fetch).mock.calls.map(([input]) => String(input));
    expect(asked.at(-1)).toBe("https://b.example/deep/1.png");
  });

  it("fetches a page once for all who want it, and keeps it for sharper drawings", async () => {
    const png = await image(100, 100);
    serve(() => new Response(png));
    const source = await openSource(["https://a.example/1.png"]);
    await Promise.all([source.size(0), source.draw(0, 10, never), source.draw(0, 50, never)]);
    await source.draw(0, 100, never);
    expect(fetch).toHaveBeenCalledTimes(1);
  });

  it("stops fetching when nobody waits any more", async () => {
    let own: AbortSignal | null | undefined;
    serve((_, init) => {
      own = init?.signal;
      return new Promise((_, reject) => {
        own?.addEventListener("abort", () => reject(own?.reason));
      });
    });
    const source = await openSource(["https://a.example/1.png"]);
    const controller = new AbortController();
    const drawing = source.draw(0, 10, controller.signal);
    controller.abort(new Error("turned on"));
    await expect(drawing).rejects.toThrow("turned on");
    expect(own?.aborted).toBe(true);
  });
});

describe("what cannot be read is told in one sentence", () => {
  const fails = (answer: () => Response, address = "https://a.example/a%20book.json") => {
    serve(answer);
    return messageOf(openSource(address));
  };

  it("not found", async () => {
    expect(await fails(() => new Response("", { status: 404 }))).toBe(
      "a book.json was not found; check the address and open it again.",
    );
  });
  it("refused", async () => {
    expect(await fails(() => new Response("", { status: 403 }))).toMatch(
      /^a book\.json may not be/,
    );
  });
  it("a server in trouble", async () => {
    expect(await fails(() => new Response("", { status: 503 }))).toMatch(
      /answered 503\); try again/,
    );
  });
  it("unreachable", async () => {
    const fail = (): Response => {
      throw new TypeError("Failed to fetch");
    };
    expect(await fails(fail)).toMatch(
      /^a book\.json could not be reached; .*CORS\).*connect-src\)\.$/,
    );
  });
  it("empty", async () => {
    expect(await fails(() => new Response(""))).toBe("a book.json is empty; get the file again.");
    expect(await fails(() => new Response("", { status: 416 }))).toMatch(/is empty/);
  });
  it("a web page, an archive, an unknown format", async () => {
    expect(await fails(() => new Response("<!doctype html>"))).toMatch(
      /is a web page, not a book; PDF/,
    );
    expect(await fails(() => new Response("PK\x03\x04"))).toMatch(
      /is an archive, .* unpack it first/,
    );
    expect(await fails(() => new Response("Ishmael"))).toMatch(
      /is of an unknown format; PDF, images/,
    );
  });
  it("JSON that is none", async () => {
    expect(await fails(() => new Response("{oops"))).toMatch(/^a book\.json is no valid JSON; /);
  });
  it("an address that is none", async () => {
    expect(await messageOf(openSource("http://"))).toBe("http:// is no address; correct it.");
    expect(await messageOf(openSource("javascript:alert(1)"))).toMatch(
      /is not an address of the web/,
    );
  });
  it("a page that is no image, without harm to the others", async () => {
    const bad = URL.createObjectURL(new Blob(["no image"]));
    const source = await openSource({ title: "Atlas", pages: [bad, await address(9, 9)] });
    expect(await messageOf(source.draw(0, 9, never))).toMatch(
      /^Page 1 of This book is damaged or no/,
    );
    expect((await source.draw(1, 9, never)).width).toBe(9);
  });
  it("a page that is not there", async () => {
    serve(() => new Response("", { status: 404 }));
    const source = await openSource(["https://a.example/scans/003.jpg"]);
    expect(await messageOf(source.draw(0, 9, never))).toBe(
      "Page 1 of This book (003.jpg) was not found; check the address and open it again.",
    );
  });
});
