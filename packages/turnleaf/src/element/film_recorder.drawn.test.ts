import { afterEach, expect, it, vi } from "vitest";
import type { TurnleafBook } from "../element.ts";
import { clock, removeClock } from "../for_tests/clock.ts";
import { book, happens, scans, settled } from "../for_tests/element_books.ts";
import { eventually } from "../for_tests/eventually.ts";

// An encoder takes its pictures by the machine's clock.
removeClock();

afterEach(() => {
  vi.restoreAllMocks();
  for (const element of document.querySelectorAll("turnleaf-book")) element.remove();
});

/** Returns an open book whose pages turn in `duration` milliseconds. */
async function open(duration = "300"): Promise<TurnleafBook> {
  const element = book(scans(6), { theme: "light", duration });
  await happens(element, "load");
  await settled(element);
  return element;
}

/** Returns the distinct pictures of a film as it plays, each as a few of its pixels. */
async function watch(film: Blob): Promise<{ width: number; height: number; looks: string[] }> {
  const video = document.createElement("video");
  video.muted = true;
  video.src = URL.createObjectURL(film);
  const looks = new Set<string>();
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 16;
  const pen = canvas.getContext("2d", { willReadFrequently: true }) as CanvasRenderingContext2D;
  const look = (): void => {
    pen.drawImage(video, 0, 0, 16, 16);
    looks.add(pen.getImageData(0, 0, 16, 16).data.join());
    video.requestVideoFrameCallback(look);
  };
  video.requestVideoFrameCallback(look);
  const ended = new Promise((resolve) => video.addEventListener("ended", resolve));
  await video.play();
  await ended;
  const { videoWidth: width, videoHeight: height } = video;
  URL.revokeObjectURL(video.src);
  return { width, height, looks: [...looks] };
}

it("a turn is recorded, with the desk about the book", async () => {
  // An encoder that starts on a busy machine takes its first picture a second late: a
  // turn of 300 ms was over by then, and its film a single picture.
  const element = await open("3000");
  const recorded = element.record();
  await eventually(() => element.recording).toBe(true);
  await element.next();
  await settled(element);
  element.stopRecording();
  const film = await recorded;
  expect(element.recording).toBe(false);
  expect(film.type).toBe("video/webm");
  const { width, height, looks } = await watch(film);
  expect([width, height]).toEqual([300, 220]);
  expect(looks.length).toBeGreaterThan(1);
  for (const look of looks) {
    // The corner is the desk's grey brown, neither black nor white.
    const [red = 0, green = 0, blue = 0] = look.split(",").map(Number);
    expect(red > 120 && red < 230 && red > blue && Math.abs(red - green) < 30).toBe(true);
    expect(look.includes(",0,0,0,0")).toBe(false);
  }
});

it("ends by itself after its seconds, and when the element goes; what lies still is seen", async () => {
  const element = await open();
  const short = await element.record({ seconds: 1 });
  expect(short.size).toBeGreaterThan(500);
  const { looks } = await watch(short);
  // The paper of the pages, from the first picture on.
  for (const look of looks) {
    const reds = look
      .split(",")
      .filter((_, i) => i % 4 === 0)
      .map(Number);
    expect(Math.max(...reds)).toBeGreaterThan(208);
  }
  const gone = element.record();
  await eventually(() => element.recording).toBe(true);
  await element.next();
  element.remove();
  expect((await gone).size).toBeGreaterThan(500);
});

it("counts its seconds from its first picture, however late that is drawn", async () => {
  const element = await open();
  const frames: FrameRequestCallback[] = [];
  vi.spyOn(window, "requestAnimationFrame").mockImplementation((call) => frames.push(call));
  let isOver = false;
  const film = element.record({ seconds: 0.1 }).finally(() => {
    isOver = true;
  });
  await eventually(() => element.recording).toBe(true);
  await clock.pass(300);
  expect(isOver).toBe(false);
  await clock.until(() => {
    for (const call of frames.splice(0)) call(performance.now());
    return isOver;
  });
  expect((await film).size).toBeGreaterThan(500);
});

it("says in one sentence what cannot be recorded", async () => {
  const element = document.createElement("turnleaf-book");
  await expect(element.record()).rejects.toThrow("There is no book to record; open one.");
  const other = await open();
  const first = other.record();
  await eventually(() => other.recording).toBe(true);
  await expect(other.record()).rejects.toThrow("A film is recorded already.");
  await other.next();
  other.stopRecording();
  await first;
  vi.spyOn(MediaRecorder, "isTypeSupported").mockReturnValue(false);
  await expect(other.record()).rejects.toThrow(
    "This browser cannot record a film; use a newer one.",
  );
  expect(other.recording).toBe(false);
});
