/** Scenes of a book whose leaves are turned, folded, torn out, crumpled and unfolded in WASM: what their frames take. */

import { foldCorner, Riffle } from "../wasm/tests/riffle.mjs";

/** Microseconds of each of 120 frames of a riffle with so many leaves in flight; of 60 dog-eared ones if they are folded. */
export function riffleFrames(wasm, count, isFolded = false) {
  let book = 0;
  const own = { ...wasm, tl_book_new: (...size) => (book = wasm.tl_book_new(...size)) };
  const riffle = new Riffle(own, "book", count);
  for (let leaf = 1000; isFolded && leaf < 1060; leaf++) foldCorner(wasm, book, leaf);
  const frames = [];
  for (let frame = 0; frame < 120; frame++) {
    const start = performance.now();
    riffle.frame();
    frames.push(1000 * (performance.now() - start));
  }
  riffle.drop();
  return frames;
}

/**
 * Microseconds of a frame at 60 Hz of so many dog-eared leaves next to each other in a book whose
 * other leaves are whole: all of them are turned over, a tenth of a second apart, and when they are
 * at rest back, so many times in all. Two ticks and what is drawn, while any turns or comes to rest.
 */
export function foldedTurns(wasm, count, turns = 20) {
  const frames = [];
  const [book, first] = [wasm.tl_book_new(0.148, 0.21, 100, 0.01), 50];
  wasm.tl_board_lay(book, 0, 1);
  wasm.tl_book_lay(book, first);
  for (let leaf = first; leaf < first + count; leaf++) foldCorner(wasm, book, leaf);
  for (let turn = 0; turn < turns; turn++) {
    const from = turn % 2;
    let lifted = 0;
    for (let frame = 0; lifted < count || wasm.tl_book_asleep(book) === 0; frame++) {
      if (frame > 1200) throw new Error("The leaves do not come to rest.");
      const start = performance.now();
      if (lifted < count && frame === 6 * lifted) {
        const low = from === 0 ? first + lifted : first + count - 1 - lifted;
        const id = wasm.tl_book_lift(book, from, low, low + 1);
        if (id === 0) throw new Error(`Leaf ${low} is not picked up.`);
        wasm.tl_book_play(book, id, 1 - from, 0.6);
        lifted++;
      }
      wasm.tl_book_step(book, 2);
      wasm.tl_book_update(book);
      frames.push(1000 * (performance.now() - start));
    }
  }
  wasm.tl_book_drop(book);
  return frames;
}

/** Microseconds of a frame at 60 Hz of a fold-out's flap that opens and shuts ten times: two ticks and what is drawn. */
export function flapFrames(wasm, panels) {
  const frames = [];
  const book = wasm.tl_book_new(0.148, 0.21, 100, 0.01);
  wasm.tl_board_lay(book, 0, 1);
  wasm.tl_book_lay(book, 50);
  wasm.tl_book_update(book);
  const flap = wasm.tl_flap_new(book, 0, 0.98, 0.97 * panels, panels, -0.004, 0.003);
  if (flap === 0) throw new Error("There is no flap.");
  for (let turn = 0; turn < 20; turn++) {
    wasm.tl_flap_turn(flap, 1 - (turn % 2));
    while (wasm.tl_flap_asleep(flap) === 0) {
      const start = performance.now();
      wasm.tl_flap_step(flap, book, 2);
      frames.push(1000 * (performance.now() - start));
    }
  }
  wasm.tl_flap_drop(flap);
  wasm.tl_book_drop(book);
  return frames;
}

/**
 * Microseconds of a frame at 60 Hz in which a sewn leaf is torn out of a book and then carried, of
 * one in which it is crumpled after that, and of one in which it is torn across by two grabs: two
 * ticks of the book and of the sheet, and what is drawn of both. All frames of some such leaves, half
 * of which are crumpled; then how long a tear takes to begin and its pieces to part.
 *
 * @param turns whether the grabs swing as they tear a leaf across, and its path turns with them
 */
export function tornFrames(wasm, turns = false, count = 40) {
  const frames = [];
  const ofBall = [];
  const ofTear = [];
  const begun = [];
  const parted = [];
  for (let k = 0; k < count; k++) {
    const book = wasm.tl_book_new(0.14, 0.21, 100, 0.009);
    wasm.tl_board_lay(book, 0, 1);
    wasm.tl_book_lay(book, 50);
    const id = wasm.tl_book_lift(book, 0, 50, 51);
    wasm.tl_book_grab(book, id, 0, 0.95, 0.95);
    wasm.tl_book_hold(book, id, 0, 0.13, 0.2, 0.02);
    wasm.tl_book_step(book, 40);
    wasm.tl_book_update(book);
    const leaf = wasm.tl_torn_new(book, id, 0, 0, 14, 0, 0);
    wasm.tl_torn_grab(leaf, 0, 0.95, 0.95);
    for (let frame = 0; frame < 60; frame++) {
      const away = 0.003 * frame;
      const start = performance.now();
      wasm.tl_book_step(book, 2);
      wasm.tl_book_update(book);
      wasm.tl_torn_pull(leaf, 0, 0.13 + 0.8 * away, 0.2, 0.02 + 0.6 * away);
      wasm.tl_torn_step(leaf, book, 2);
      frames.push(1000 * (performance.now() - start));
    }
    if (wasm.tl_torn_bound_high(leaf) !== 0) throw new Error("The leaf is not off.");
    const step = (to, pull = () => {}) => {
      const start = performance.now();
      wasm.tl_book_step(book, 2);
      wasm.tl_book_update(book);
      pull();
      wasm.tl_torn_step(leaf, book, 2);
      to.push(1000 * (performance.now() - start));
    };
    if (k % 2 === 1) {
      let start = performance.now();
      if (wasm.tl_torn_across(leaf, 0, 0.5, 1, 0.45, turns) === 0)
        throw new Error("It is not torn.");
      begun.push(1000 * (performance.now() - start));
      wasm.tl_torn_grab(leaf, 0, 0.2, 0.35);
      wasm.tl_torn_grab(leaf, 1, 0.2, 0.65);
      for (let frame = 0; wasm.tl_torn_opened(leaf) < 1; frame++) {
        if (frame > 600) throw new Error("The sheet is not torn through.");
        const away = 0.0025 * frame;
        // A quarter of a circle a second.
        const swing = turns ? (Math.PI / 2) * (frame / 60) : 0;
        const [x, y] = [away * Math.sin(swing), away * Math.cos(swing)];
        step(ofTear, () => {
          wasm.tl_torn_pull(leaf, 0, 0.3 + x, 0.1 - y, 0.15);
          wasm.tl_torn_pull(leaf, 1, 0.3 - x, 0.1 + y, 0.15);
        });
      }
      start = performance.now();
      wasm.tl_torn_drop(wasm.tl_torn_part(leaf));
      parted.push(1000 * (performance.now() - start));
      wasm.tl_torn_drop(leaf);
      wasm.tl_book_drop(book);
      continue;
    }
    if (wasm.tl_torn_crumple(leaf) === 0) throw new Error("The sheet is not crumpled.");
    while (wasm.tl_torn_asleep(leaf) === 0) step(ofBall);
    wasm.tl_torn_drop(leaf);
    wasm.tl_book_drop(book);
  }
  return [frames, ofBall, ofTear, begun, parted];
}

/**
 * Microseconds of a frame at 60 Hz in which a loose sheet is raised, carried and let fall until it
 * lies: alone; upon two others that lie; and out from below these, which move then too. Two ticks of
 * what moves, and what is drawn of it, without the book's own.
 */
export function droppedFrames(wasm) {
  const frames = [[], [], []];
  const book = wasm.tl_book_new(0.14, 0.21, 100, 0.009);
  wasm.tl_board_lay(book, 0, 1);
  wasm.tl_book_lay(book, 50);
  wasm.tl_book_update(book);
  const together = (sheets, to) => {
    new Uint32Array(wasm.memory.buffer, wasm.tl_torn_sheets(), sheets.length).set(sheets);
    const start = performance.now();
    wasm.tl_torn_step_together(sheets.length, book, 2);
    to.push(1000 * (performance.now() - start));
  };
  /** Carries the last of some sheets, or another, by a corner to where `at` says, and lets it fall. */
  const carry = (sheets, sheet, at, to) => {
    wasm.tl_torn_grab(sheet, 0, 0.9, 0.8);
    for (let frame = 0; frame < 40; frame++) {
      wasm.tl_torn_pull(sheet, 0, ...at(Math.min(frame / 30, 1)));
      together(sheets, to);
    }
    wasm.tl_torn_release(sheet);
    while (sheets.some((one) => wasm.tl_torn_asleep(one) === 0)) together(sheets, to);
  };
  for (let k = 0; k < 10; k++) {
    const sheets = [];
    for (const to of [frames[0], [], frames[1]]) {
      sheets.push(wasm.tl_torn_blank(book, -0.004, 0.003));
      // From over the pages to beside them, each a little farther.
      const beside = 0.38 + 0.01 * sheets.length;
      const at = (part) => [0.126 + part * (beside - 0.126), 0.17 - 0.02 * k * part, 0.06];
      carry(sheets, sheets.at(-1), at, to);
    }
    carry(sheets, sheets[0], (part) => [0.39 + 0.3 * part, 0.17, 0.06], frames[2]);
    for (const sheet of sheets) wasm.tl_torn_drop(sheet);
  }
  wasm.tl_book_drop(book);
  return frames;
}
