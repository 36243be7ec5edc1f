/**
 * Unpacks machine code. Each bit was packed in as many bits as it came unexpected
 * after those before it, by arithmetic coding; what expects it, here, is a mixture
 * of predictors that know where in an operation a byte stands. That packs a third
 * smaller than deflate, which browsers have, and a fifth smaller than LZMA. The
 * packer runs the same expectation, so every step of it is one that IEEE 754
 * rounds exactly: no exp, no log.
 */

/** What a byte may be: an operation, the second byte of one on vectors, or what follows one. */
const [operation, vectorOperation, local, number, raw, groupsOfLocals] = [0, 1, 2, 3, 4, 5];
const kinds = 6;

/** Predictors, each by what it takes for the same situation. */
const predictors = 8;
/** Inputs of the mixture: the predictors, what followed the last time, and what is so without a reason. */
const inputs = predictors + 2;
/** Situations that a predictor tells apart, as a power of two. */
const situations = 19;
/** Times after which a predictor trusts what it saw no more than before. */
const mostSeen = 6;
/** How fast the mixture learns, and the error below which it is right as it is. */
const learning = 0.016;
const smallError = 0.03;

/** Shortest and longest run of bytes seen before that tells what comes next. */
const shortestRun = 4;
const longestRun = 31;

/** Odds of a bit by its weight of evidence, ln(p / (1 - p)) in 128ths, from -8 to 8; and the other way. */
const oddsOf = new Float32Array(2048);
const evidenceOf = new Float32Array(4096);

function makeTables(): void {
  // e^(1/128), over and over.
  for (let i = 0, grown = 1; i < 1024; i++, grown *= 1.007843097206448) {
    oddsOf[1024 + i] = grown / (1 + grown);
    oddsOf[1024 - i] = 1 / (1 + grown);
  }
  for (let p = 0, i = 1; p < 4096; p++) {
    while (i < 2047 && (oddsOf[i] as number) * 4096 < p) i++;
    evidenceOf[p] = (i - 1024) / 128;
  }
}

const odds = (evidence: number): number =>
  oddsOf[evidence > 7.9 ? 2035 : evidence < -7.9 ? 13 : (evidence * 128 + 1024.5) | 0] as number;

/** What follows an operation: kinds of what is written in one or more bytes, or less than 0, a number of raw ones. */
function following(op: number): number[] {
  if (op >= 32 && op <= 34) return [local];
  if (op >= 40 && op <= 62) return [number, number];
  if (op === 67) return [-4];
  if (op === 68) return [-8];
  if (op === 253) return [vectorOperation];
  if (op === 252) return [number, number];
  const isOne = (op >= 2 && op <= 4) || [12, 13, 16, 35, 36, 65, 66].includes(op);
  return isOne ? [number] : [];
}

/** What follows the second byte of an operation on vectors. A third one is taken for an operation. */
function followingVector(op: number): number[] {
  if (op <= 11 || op === 92 || op === 93) return [number, number];
  if (op <= 13) return [-16];
  if (op >= 21 && op <= 34) return [-1];
  return op >= 84 && op <= 91 ? [number, number, -1] : [];
}

/** Bytes between pauses: about 10 ms of work. */
const slice = 6000;

/** Lets the page do what waits: a message comes after it, and unlike a timer's also in a hidden page. */
function pause(): Promise<void> {
  return new Promise((resolve) => {
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => {
      port1.close();
      resolve();
    };
    port2.postMessage(0);
  });
}

/**
 * Bytes as `next` tells them bit by bit, the highest of each first. It pauses every few
 * milliseconds, as a page that stands still for a fifth of a second is noticed.
 *
 * @param start where the functions begin; bytes before are of no known kind
 * @param next answers a bit, told the odds (more than 0, less than 1) that it is 1
 */
export async function expectBytes(
  length: number,
  start: number,
  next: (odds: number) => number,
): Promise<Uint8Array<ArrayBuffer>> {
  makeTables();
  const out = new Uint8Array(length);
  const rates = Float64Array.from({ length: mostSeen + 1 }, (_, n) => 1 / (n + 1.15));
  /** The odds of 1 in 26 bits, above how often a situation was met. */
  const cells = new Int32Array(predictors << situations).fill(2 ** 30);
  // Three mixtures: by the kind and the bits of the byte so far, by the run, the kind and
  // what was read of it, and by the kind, the byte before and which half of a byte it is.
  const mixture = (rows: number) => new Float32Array(rows * inputs).fill(1.8 / predictors);
  const [byKind, byRun, byLast] = [mixture(kinds * 256), mixture(16 * 64), mixture(kinds * 512)];
  const evidence = new Float32Array(inputs).fill(0.4);
  /** What each predictor goes by, as a number and mixed. */
  const known = new Int32Array(predictors);
  const hashes = new Int32Array(predictors);
  const slots = new Int32Array(predictors);

  let kind = raw;
  let left = start;
  let todo = [groupsOfLocals];
  /** Bytes so far of what is being read, and its number. */
  let [read, value] = [0, 0];
  /** The last four operations, the latest first, and how many blocks they lie in. */
  let [op, op1, op2, op3, depth] = [0, 0, 0, 0, 0];
  let last = 0;

  /** Where bytes like the last four were followed by others, and how sure of it their number makes. */
  const places = new Int32Array(1 << 16);
  const sureness = new Float64Array(longestRun + 1).fill(0.5);
  let [place, run, expected, node] = [0, 0, 0, 1];

  const hash = (): void => {
    const at = kind * 8 + Math.min(read, 7);
    known[0] = at;
    known[1] = last & 255;
    known[2] = last & 65535;
    known[3] = op;
    known[4] = op | (op1 << 9);
    known[5] = op ^ (op1 << 8) ^ (op2 << 16) ^ (op3 << 24);
    known[6] = op | (depth << 9);
    known[7] = op | (op1 << 9) | (op2 << 18);
    for (let i = 0; i < predictors; i++) {
      const mixed = Math.imul((known[i] as number) + 1, 0x2f0b4c47);
      const told = mixed ^ Math.imul(at + 1 + 128 * i, 0x9e3779b1);
      hashes[i] = told ^ (told >>> 15);
    }
  };
  /** Finds the predictors' sixteen cells for the next half of the byte. */
  const seek = (): void => {
    for (let i = 0; i < predictors; i++) {
      let mixed = Math.imul((hashes[i] as number) + node, 0x2c1b3c6d);
      mixed = Math.imul(mixed ^ (mixed >>> 15), 0x297a2d39);
      slots[i] = (i << situations) + ((mixed >>> (32 - situations)) & ~15);
    }
  };
  const readBit = (above: number): void => {
    const low = above > 3 ? node : (1 << (3 - above)) | (node & ((1 << (3 - above)) - 1));
    const isExpected = expected >> (above + 1) === node;
    const guess = (expected >> above) & 1;
    const a = (kind * 256 + node) * inputs;
    const b = ((isExpected ? Math.min(run, 15) : 0) * 64 + kind * 8 + Math.min(read, 7)) * inputs;
    const c = (kind * 512 + (above & 4) * 64 + (last & 255)) * inputs;
    const sure = 1.5 * (evidenceOf[((sureness[run] as number) * 4096) | 0] as number);
    evidence[predictors] = isExpected ? (guess ? sure : -sure) : 0;
    let [sumA, sumB, sumC] = [0, 0, 0];
    for (let i = 0; i < inputs; i++) {
      if (i < predictors) {
        const cell = cells[(slots[i] as number) + low] as number;
        evidence[i] = (cell & 31) === 0 ? 0 : (evidenceOf[cell >> 19] as number);
      }
      const said = evidence[i] as number;
      sumA += (byKind[a + i] as number) * said;
      sumB += (byRun[b + i] as number) * said;
      sumC += (byLast[c + i] as number) * said;
    }
    const expects = odds((sumA + sumB + sumC) / 3);
    const bit = next(expects);
    if (Math.abs(bit - expects) >= smallError) {
      const stepA = (bit - odds(sumA)) * learning;
      const stepB = (bit - odds(sumB)) * learning;
      const stepC = (bit - odds(sumC)) * learning;
      for (let i = 0; i < inputs; i++) {
        const said = evidence[i] as number;
        byKind[a + i] = (byKind[a + i] as number) + stepA * said;
        byRun[b + i] = (byRun[b + i] as number) + stepB * said;
        byLast[c + i] = (byLast[c + i] as number) + stepC * said;
      }
    }
    const aim = bit * (2 ** 31 - 1);
    for (let i = 0; i < predictors; i++) {
      const at = (slots[i] as number) + low;
      const cell = cells[at] as number;
      const seen = cell & 31;
      const moved = (cell + (aim - cell) * (rates[seen] as number)) & ~31;
      cells[at] = moved | Math.min(seen + 1, mostSeen);
    }
    if (isExpected) {
      const sureOf = sureness[run] as number;
      sureness[run] = sureOf + ((bit === guess ? 1 : 0) - sureOf) * 0.02;
      if (bit !== guess) expected = run = 0;
    }
    node = (node << 1) | bit;
  };

  /** Tells what the next byte is, after this one. */
  const parse = (byte: number): void => {
    read++;
    if (kind === operation) {
      [op3, op2, op1, op] = [op2, op1, op, byte];
      todo = following(byte);
      if (byte >= 2 && byte <= 4) depth++;
      // The end of a function: the length of the next one and its locals follow.
      if (byte === 11 && depth-- === 0) {
        depth = 0;
        todo = [number, groupsOfLocals];
      }
    } else if (kind === vectorOperation) {
      op = 256 + byte;
      todo = followingVector(byte);
    } else if (kind === raw) {
      if (read < left) return;
    } else {
      value |= (byte & 127) << (7 * (read - 1));
      if (byte >= 128) return;
      // No function has 64 types of locals; what is none may say anything.
      if (kind === groupsOfLocals) todo = new Array(2 * (value & 63)).fill(number);
    }
    [read, value] = [0, 0];
    kind = todo.shift() ?? operation;
    if (kind < 0) [kind, left] = [raw, -kind];
  };

  for (let to = 0; to < length; to++) {
    if (to % slice === slice - 1) await pause();
    hash();
    [node, expected] = [1, run > 0 ? (out[place] as number) | 256 : 0];
    for (let above = 7; above >= 0; above--) {
      if (above === 7 || above === 3) seek();
      readBit(above);
    }
    const byte = node & 255;
    out[to] = byte;
    parse(byte);
    last = (last << 8) | byte;
    const found = Math.imul(last, 0x9e3779b1) >>> 16;
    if (run > 0) [place, run] = [place + 1, Math.min(run + 1, longestRun)];
    else {
      place = places[found] as number;
      while (run < longestRun && run < place && out[place - 1 - run] === out[to - run]) run++;
      if (run < shortestRun) run = 0;
    }
    places[found] = to + 1;
  }
  return out;
}

/**
 * The bytes that were packed.
 * @param packed their number and where functions begin, 4 bytes each, the lowest
 *   first, and what the coder wrote. It is trusted: broken bytes give broken bytes
 */
export function unpackCode(packed: Uint8Array): Promise<Uint8Array<ArrayBuffer>> {
  const view = new DataView(packed.buffer, packed.byteOffset);
  let at = 12;
  let [low, high, code] = [0, 2 ** 32 - 1, view.getUint32(8)];
  return expectBytes(view.getUint32(0, true), view.getUint32(4, true), (odds) => {
    const middle = low + Math.floor((high - low) * odds);
    const isOne = code <= middle;
    if (isOne) high = middle;
    else low = middle + 1;
    while ((low ^ high) >>> 24 === 0) {
      low = (low << 8) >>> 0;
      high = ((high << 8) | 255) >>> 0;
      code = ((code << 8) | (packed[at++] ?? 0)) >>> 0;
    }
    return isOne ? 1 : 0;
  });
}

/** The shortest module there is: its magic number and version. */
const emptyModule = Uint8Array.of(0, 0x61, 0x73, 0x6d, 1, 0, 0, 0);

/** Whether there is WebAssembly, and the page's security policy lets it run. */
export function mayRunCode(): boolean {
  try {
    return new WebAssembly.Module(emptyModule) instanceof WebAssembly.Module;
  } catch {
    return false;
  }
}
