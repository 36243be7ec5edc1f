/**
 * Key frames: a turn recorded once and played on any page of its ratio, reversed,
 * mirrored, faster or of another size, without the engine. Runs in browsers and
 * in Node.
 */

export { type Model, models } from "../model_names.ts";
export {
  type PaperMesh,
  type SplitMesh,
  splitMesh,
  writeMeshNormals,
} from "../paper_mesh.ts";
export { decodeTurn } from "./decode.ts";
export { TurnError } from "./file.ts";
export { RecordedTurn, writeNormals } from "./recorded_turn.ts";
export { type RecordedLeaf, type TurnFile, TurnRecorder } from "./recorder.ts";
export { TurnCache, type TurnCacheOptions, turnName } from "./turn_cache.ts";
