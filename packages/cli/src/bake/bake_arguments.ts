import { extname } from "node:path";
import { models } from "turnleaf/keyframes";
import type { LeafStockName, Model } from "turnleaf/models";
import { oneOf, parseNumber, parseOptions, parseSize } from "../options.ts";
import { UsageProblem } from "../problem.ts";

/** Every paper, the default first: listed here, so that reading a book loads no model. */
const stocks = Object.keys({
  book: 0,
  bible: 0,
  office: 0,
  coated: 0,
  card: 0,
} satisfies Record<LeafStockName, 0>) as LeafStockName[];

/** The output formats. */
const formats = ["glb", "obj", "json", "tlkf"] as const;
/** How the leaf is turned. */
const gestures = ["corner", "edge", "let-go"] as const;

/** A turn to bake. */
export interface BakeCommand {
  readonly name: "bake";
  readonly model: Model;
  readonly gesture: (typeof gestures)[number];
  readonly stock: LeafStockName;
  readonly out: string;
  readonly format: (typeof formats)[number];
  /** Duration of the grab; the leaf then comes to rest. */
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
  --gesture NAME     corner, edge or let-go (corner)
  --stock NAME       bible, book, office, coated or card (book)
  --seconds S        how long the turn takes; then the leaf comes to rest (0.8)
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
  const { values, positionals } = parseOptions(args, [
    ...["out", "model", "gesture", "stock", "seconds", "size", "points"],
    ...["tolerance", "fps", "front", "back"],
  ]);
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
  return {
    name: "bake",
    model: oneOf("model", values.model ?? "sheet", models),
    gesture: oneOf("gesture", values.gesture, gestures),
    stock: oneOf("stock", values.stock, stocks),
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
