import { basename, extname } from "node:path";
import { models } from "turnleaf/keyframes";
import type { LeafCrease, LeafStockName, Model } from "turnleaf/models";
import { oneOf, parseNumber, parseOptions, parseSize } from "../options.ts";
import { UsageProblem } from "../problem.ts";
import { stockNames, stockWords } from "../stock_names.ts";

/** The output formats. */
const formats = ["glb", "obj", "json", "tlkf"] as const;
/** How the leaf is turned, or that it is folded where it lies. */
const gestures = ["corner", "edge", "let-go", "fold"] as const;

/** A turn to bake. */
export interface BakeCommand {
  readonly name: "bake";
  readonly model: Model;
  readonly gesture: (typeof gestures)[number];
  readonly stock: LeafStockName;
  readonly out: string;
  readonly format: (typeof formats)[number];
  /** Creases of the leaf, in the order in which it is folded along them. */
  readonly creases: readonly LeafCrease[];
  /** Duration of the grab, or of each fold; the leaf then comes to rest. */
  readonly seconds: number;
  /** Frames per second of formats written frame by frame. */
  readonly fps: number;
  /** Size of the leaf, metres. */
  readonly width: number;
  readonly height: number;
  /** Columns and rows of points. */
  readonly points: readonly [number, number];
  /** Maximum distance of the output from the turn, over the width. */
  readonly tolerance: number;
  /** Images of both sides. */
  readonly front: string | undefined;
  readonly back: string | undefined;
}

export const bakeHelp = `turnleaf bake --out FILE writes the turn of a leaf for other programs.

  --out FILE         turn.glb   glTF 2.0 with morph targets, both sides textured
                     turn.obj   one OBJ a frame: turn_0001.obj and so on
                     turn.json  positions of every frame
                     turn.tlkf  key frames, for turnleaf/keyframes
  --model NAME       ${models.join(", ")} (sheet)
  --gesture NAME     corner, edge or let-go; fold with --crease (corner; fold)
  --crease "U,V U,V ANGLE"  crease the sheet along the line through two places,
                     0,0 at the foot of the spine and 1,1 at the head of the
                     fore-edge, to a rest angle of -180 to 180 degrees, above 0
                     toward the recto; once for each crease, in the order in
                     which they are folded
  --stock NAME       ${stockWords} (book)
  --seconds S        how long the turn or each fold takes; then the leaf comes
                     to rest (0.8)
  --size WxH         of the leaf, millimetres (148x210)
  --points CxR       columns and rows of points, 2 to 200 (26x26)
  --tolerance E      how far .glb and .tlkf may be from the turn, over the width
                     (0.001)
  --fps N            frames a second of .obj and .json, 1 to 240 (30)
  --front, --back IMAGE   PNG or JPEG on the recto and on the verso
`;

/**
 * Parses the arguments of `turnleaf bake`.
 *
 * @throws UsageProblem
 */
export function parseBake(args: readonly string[]): BakeCommand {
  const names = [
    ...["out", "model", "gesture", "stock", "seconds", "size", "points"],
    ...["tolerance", "fps", "front", "back"],
  ];
  const { values, lists, positionals } = parseOptions(args, names, [], ["crease"]);
  if (positionals.length > 0) {
    throw new UsageProblem("A turn is baked from its options alone; name the file with --out.");
  }
  const { out } = values;
  const ending = extname(out ?? "")
    .slice(1)
    .toLowerCase();
  const format = formats.find((format) => format === ending);
  if (!out || !format) {
    throw new UsageProblem(
      "Say where the turn goes: --out turn.glb, turn.obj, turn.json or turn.tlkf",
    );
  }
  const size = parseSize("size", values.size ?? "148x210", 10, 2000);
  const points = parseSize("points", values.points ?? "26x26", 2, 200);
  if ((values.front || values.back) && format !== "glb" && format !== "obj") {
    throw new UsageProblem("--front and --back are for .glb and .obj.");
  }
  // Its files name each other by lines, in which nothing can be escaped.
  const named = format === "obj" ? [basename(out), values.front, values.back] : [];
  if (named.some((name) => name && /[\p{Cc}\u2028\u2029]|\\$/u.test(name))) {
    throw new UsageProblem(
      "The files of an .obj name each other; no name may have a line break or end with \\.",
    );
  }
  const creases = (lists.crease ?? []).map(parseCrease);
  const model = oneOf("model", values.model ?? "sheet", models);
  if (creases.length > 0 && model !== "sheet") {
    throw new UsageProblem("Of all models only the sheet can be creased.");
  }
  const gesture = oneOf(
    "gesture",
    values.gesture ?? (creases.length > 0 ? "fold" : "corner"),
    gestures,
  );
  if (gesture === "fold" && creases.length === 0) {
    throw new UsageProblem("A leaf is folded along a --crease; give one at least.");
  }
  return {
    name: "bake",
    model,
    gesture,
    creases,
    stock: oneOf("stock", values.stock, stockNames),
    out,
    format,
    seconds: parseNumber("seconds", values.seconds, 0.8, 0.1, 60),
    fps: parseNumber("fps", values.fps, 30, 1, 240),
    width: size.width / 1000,
    height: size.height / 1000,
    points: [points.width, points.height],
    tolerance: parseNumber("tolerance", values.tolerance, 0.001, 0.00001, 0.1),
    front: values.front,
    back: values.back,
  };
}

/** Parses a crease: two places and a rest angle in degrees. */
function parseCrease(text: string): LeafCrease {
  const number = "(-?\\d+(?:\\.\\d+)?)";
  const match = new RegExp(`^${number},${number} ${number},${number} ${number}$`).exec(text);
  const [a = -1, b = -1, c = -1, d = -1, angle = 999] = (match ?? []).slice(1).map(Number);
  const isOnLeaf = [a, b, c, d].every((place) => place >= 0 && place <= 1);
  if (!isOnLeaf || Math.abs(angle) > 180 || (a === c && b === d)) {
    throw new UsageProblem(
      '--crease is two places on the leaf and an angle of -180 to 180 degrees, such as "0.7,0 1,0.2 150".',
    );
  }
  return { through: [a, b, c, d], rest: (angle * Math.PI) / 180 };
}
