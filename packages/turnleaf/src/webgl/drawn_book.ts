/**
 * The book as meshes: pages, piles, leaves, boards, spine and their shadow on
 * the table. A pose moves them; parts that have not moved cost nothing.
 */

import { Group, Object3D } from "three";
import { type Face, isBoardFace } from "../book/faces.ts";
import { nextTo } from "../book/leaf_order.ts";
import { Side } from "../engine/phases.ts";
import type { Paper, Surface, Vec3 } from "../engine/shapes.ts";
import type { BookPose, BookShape } from "../stage/book_pose.ts";
import { caseSizes, tableHeight } from "../stage/case_sizes.ts";
import { showsStaples, thickestStapled } from "../stage/staples.ts";
import { BoardMesh } from "./board_mesh.ts";
import type { Framing } from "./camera.ts";
import { placeCase, restingCase } from "./case_shape.ts";
import { cutOff, straightened } from "./creased_vertices.ts";
import { EndpaperMesh } from "./endpaper_mesh.ts";
import { shadowOfCase, shadowOfFlap, shadowOfLeaves, shadowOfSheet } from "./footprint.ts";
import { Ground } from "./ground.ts";
import { LeafMesh } from "./leaf_mesh.ts";
import type { BookMaterials } from "./materials.ts";
import { castOver, overheadOf } from "./overhead.ts";
import { type Overhead, PageMesh, pageRows } from "./page_mesh.ts";
import { shading } from "./papers.ts";
import { PileMesh } from "./pile_mesh.ts";
import { PileShape } from "./pile_shape.ts";
import { HeadbandMesh, SpineMesh } from "./spine_mesh.ts";
import { StaplesMesh } from "./staples_mesh.ts";

/**
 * Smallest movement, metres, of the gutter over the spine that is followed: a
 * sixtieth of a pixel.
 */
const leastStep = 5e-6;

/** A side of the open book: its pile and its meshes. */
interface DrawnSide {
  readonly pile: PileShape;
  readonly page: PageMesh;
  readonly block: PileMesh;
  readonly fold: EndpaperMesh;
  readonly over: Overhead;
}

/** A pose that is to be lit. */
interface UnlitPose {
  readonly pose: BookPose;
  /** The leaves and a flap, which hangs on a fore-edge and throws no shadow on its page. */
  readonly sheets: readonly Surface[];
  /** Whether a pile has moved since the light was computed, and whether neither pile nor board has. */
  readonly pilesMoved: boolean;
  readonly still: boolean;
}

/** All meshes of one book. */
export class DrawnBook {
  readonly group: Group = new Group();
  /** The properties of the last pose that the camera depends on. */
  readonly framing: Framing;
  readonly #shape: BookShape;
  readonly #hard: boolean;
  readonly #left: DrawnSide;
  readonly #right: DrawnSide;
  readonly #materials: BookMaterials;
  /** Created when they are needed; those in use come first, from left to right. */
  readonly #leaves: LeafMesh[] = [];
  readonly #loose: LeafMesh[] = [];
  #looseShown: readonly Surface[] = [];
  /** The loose sheet that lies upon all others. */
  #topmost: Surface | null = null;
  readonly #front: BoardMesh;
  readonly #back: BoardMesh;
  readonly #spine: SpineMesh;
  readonly #headbands: HeadbandMesh;
  readonly #staples: StaplesMesh | null;
  readonly #ground: Ground;
  /** Height of the table, metres. */
  readonly #table: number;
  readonly #case = restingCase();
  #frontAngle = Number.NaN;
  #backAngle = Number.NaN;
  /** The leaves as they were last lit. */
  #lit: readonly Surface[] = [];
  #isLit = false;
  /** The last pose, until its light is computed. */
  #unlit: UnlitPose | null = null;
  /** Whether leaves lie folded on the pages. */
  #folded: boolean | undefined;
  /** Whether the light is reused from the previous pose. */
  #isDim = false;

  constructor(shape: BookShape, materials: BookMaterials) {
    const { width, height, thickness } = shape;
    this.#shape = shape;
    this.#materials = materials;
    this.#hard = shape.cover === "hard";
    this.framing = {
      closedRight: 0,
      closedLeft: 0,
      middle: 0,
      boardEdges: [],
      flapEdge: [],
    };
    const side = (sign: 1 | -1): DrawnSide => ({
      pile: new PileShape(sign),
      page: new PageMesh(materials.pages[sign === 1 ? "right" : "left"], height, pageRows),
      block: new PileMesh(materials.leafEdges, sign, height, thickness),
      fold: new EndpaperMesh(
        materials.endpapers[sign === -1 ? "frontInside" : "backInside"],
        sign,
        height,
      ),
      over: overheadOf(height, new Float32Array(4)),
    });
    this.#left = side(-1);
    this.#right = side(1);
    const { frontOutside, frontInside, backOutside, backInside } = materials.boards;
    this.#front = new BoardMesh(true, width, height, frontOutside, frontInside);
    this.#back = new BoardMesh(false, width, height, backOutside, backInside);
    this.#spine = new SpineMesh(materials.spine, height, thickness);
    this.#headbands = new HeadbandMesh(materials.headband, height);
    this.#staples = shape.isStapled ? new StaplesMesh(materials.staples, height) : null;
    this.#table = tableHeight(shape);
    this.#ground = new Ground(this.#table, 12 * Math.max(width, height), materials.pixel);

    this.group.add(this.#ground.mesh);
    for (const { page, block, fold } of [this.#left, this.#right]) {
      page.mesh.visible = block.mesh.visible = fold.mesh.visible = false;
      this.group.add(block.mesh, page.mesh);
      if (this.#hard) this.group.add(fold.mesh);
    }
    if (this.#staples) this.group.add(this.#staples.mesh);
    if (this.#hard) {
      this.group.add(this.#front.group, this.#back.group, this.#spine.mesh);
      // A thin book is stapled and has none.
      if (thickness > thickestStapled) this.group.add(this.#headbands.mesh);
    }
  }

  /** Moves the book, and leaves its light to `light`. Returns whether the camera should follow. */
  pose(pose: BookPose, roughly = false): boolean {
    const middle = pose.lean;
    const caseMoved =
      pose.frontBoard !== this.#frontAngle ||
      pose.backBoard !== this.#backAngle ||
      Math.abs(middle - this.framing.middle) > leastStep;
    if (caseMoved) this.#placeCase(pose, middle);
    const leftMoved = this.#placeSide(this.#left, pose.left);
    const rightMoved = this.#placeSide(this.#right, pose.right);
    const pilesMoved = leftMoved || rightMoved;
    const still = !(pilesMoved || caseMoved);
    if (!still && this.#hard) this.#placeBoards();
    if (pilesMoved) this.#placeStaples(pose);
    const flapMoved = this.#followFlap(pose.flap ?? null);
    const sheets = pose.flap ? [...pose.leaves, pose.flap] : pose.leaves;
    const casting = [...sheets, ...(pose.loose ?? [])];
    const isSame = areSame(casting, this.#lit);
    const hadLoose = this.#looseShown.length > 0;
    this.#placeLoose(pose.loose ?? []);
    const mayDim = roughly && !this.#isDim && this.#unlit === null;
    this.#isDim = mayDim && still && casting.length === this.#lit.length;
    this.#folded = pose.folded;
    if (!(still && isSame && this.#isLit)) {
      this.#isLit = !this.#isDim;
      this.#placeLeaves(sheets);
      const before = this.#unlit;
      this.#unlit = {
        pose,
        sheets,
        pilesMoved: pilesMoved || before?.pilesMoved === true,
        still: still && before?.still !== false,
      };
    }
    this.#lit = casting;
    const [left, right] = [this.#left.pile, this.#right.pile];
    if (!this.#hard) shadowOfLeaves(this.#ground, this.#shape, pose.leaves, left, right);
    else if (!still) shadowOfCase(this.#ground, this.#shape, this.#case, left, right);
    if (pose.above instanceof Object3D) this.group.add(pose.above);
    const loose = this.#topmost;
    if (flapMoved || (hadLoose && !loose)) {
      shadowOfFlap(this.#ground, this.#shape, pose.flap ?? null);
    }
    if (loose) shadowOfSheet(this.#ground, loose, this.#table);
    if (!isSame) this.#shadeByPapers(pose, sheets);
    return caseMoved || flapMoved;
  }

  /**
   * Computes the light of the last pose: before each frame, so that of poses that nothing draws none
   * is computed.
   */
  light(): void {
    if (this.#unlit) this.#light(this.#unlit);
    this.#unlit = null;
  }

  /** Keeps the flap of a fold-out in the picture. Returns whether it moved. */
  #followFlap(flap: Surface | null): boolean {
    const edge = this.framing.flapEdge;
    const before = edge.join();
    edge.length = 0;
    if (flap) {
      const { positions, columns, rows, creased } = flap;
      // While it opens fold by fold its edge is not what is farthest.
      const first = creased ? 1 : columns;
      for (const row of [0, rows - 1]) {
        for (let column = first; column <= columns; column++) {
          const at = 3 * (row * columns + column) - 3;
          edge.push(positions[at], positions[at + 2]);
        }
      }
    }
    return edge.join() !== before;
  }

  /** Compiles in what loose sheets shade on the table, so that nothing waits for it when one comes. */
  expectSheets(): void {
    this.#ground.shade();
  }

  /**
   * Returns a place on a face's picture, in fractions from its upper left
   * corner, in book space of the last pose.
   */
  placeOn(face: Face, pictureX: number, pictureY: number): Vec3 {
    // The inverse of `onPicture`.
    const [x, y] = this.#shape.quarterTurned ? [pictureY, 1 - pictureX] : [pictureX, pictureY];
    if (isBoardFace(face)) {
      const board = face.startsWith("front") ? this.#front : this.#back;
      return board.placeOn(face.endsWith("Outside"), x, y);
    }
    const { pile } = face === "right" ? this.#right : this.#left;
    const at = pile.pointAt(face === "right" ? x : 1 - x);
    return [at[0], this.#shape.height * (1 - y), at[1]];
  }

  dispose(): void {
    for (const { page, block, fold } of [this.#left, this.#right]) {
      page.dispose();
      block.dispose();
      fold.dispose();
    }
    for (const leaf of [...this.#leaves, ...this.#loose]) leaf.dispose();
    this.#front.dispose();
    this.#back.dispose();
    this.#spine.dispose();
    this.#headbands.dispose();
    this.#staples?.dispose();
    this.#ground.dispose();
    this.group.clear();
  }

  #placeCase(pose: BookPose, middle: number): void {
    this.#frontAngle = pose.frontBoard;
    this.#backAngle = pose.backBoard;
    const joint = this.#hard ? caseSizes.joint : 0;
    const { thickness } = this.#shape;
    placeCase(this.#case, thickness, middle, pose.frontBoard, pose.backBoard, joint);
    this.framing.middle = middle;
    this.framing.closedRight = this.#case.closedRight;
    this.framing.closedLeft = this.#case.closedLeft;
  }

  #placeLeaves(leaves: readonly Surface[]): void {
    while (this.#leaves.length < leaves.length) {
      const { recto, verso } = this.#materials.leaf(this.#leaves.length);
      const mesh = new LeafMesh(recto, verso, this.#materials.leafEdges);
      this.group.add(mesh.recto, mesh.verso, mesh.rim.mesh);
      this.#leaves.push(mesh);
    }
    for (const [k, mesh] of this.#leaves.entries()) {
      mesh.recto.visible = mesh.verso.visible = mesh.rim.mesh.visible = k < leaves.length;
      if (k < leaves.length) mesh.shape(leaves[k], k + 1, leaves.length - k);
    }
  }

  /** @param flap the last of the leaves, if it is the flap of a fold-out: seen from above it may show either side */
  #lightLeaves(leaves: readonly Surface[], flap: Surface | null): void {
    const piles = [this.#left.pile, this.#right.pile] as const;
    const solid = leaves.map((leaf) => straightened(leaf));
    for (const [k, leaf] of leaves.entries()) {
      const mesh = this.#leaves[k];
      if (leaf === flap) mesh.lieLoose();
      else if (this.#folded) mesh.lieOpen();
      else if (!this.#isDim) mesh.light(solid[k], ...piles, solid[k - 1], solid[k + 1]);
    }
  }

  /** Places the sheets that are torn out, over everything else. */
  #placeLoose(sheets: readonly Surface[]): void {
    const shown = this.#looseShown;
    if (areSame(sheets, shown)) return;
    const ranks = ranksOf(sheets);
    this.#topmost = sheets[ranks.indexOf(sheets.length - 1)] ?? null;
    while (this.#loose.length < sheets.length) {
      const { recto, verso } = this.#materials.loose(this.#loose.length);
      const mesh = new LeafMesh(recto, verso, this.#materials.leafEdges);
      this.group.add(mesh.recto, mesh.verso, mesh.rim.mesh);
      this.#loose.push(mesh);
    }
    for (const [k, mesh] of this.#loose.entries()) {
      mesh.recto.visible = mesh.verso.visible = mesh.rim.mesh.visible = k < sheets.length;
      if (k >= sheets.length) continue;
      const over = this.#leaves.length + ranks[k] + 1;
      if (shown[k] !== sheets[k]) {
        mesh.shape(sheets[k], over, over);
        mesh.lieLoose();
      }
      for (const { material } of [mesh.recto, mesh.verso]) {
        // Another may have come to lie under it, or on it.
        material.lieOver(over, over);
      }
    }
    this.#looseShown = sheets;
  }

  /** Shades everything by paper that lies on it: what is folded over, and loose sheets. */
  #shadeByPapers({ leaves, lying = [], loose = [] }: BookPose, sheets: readonly Surface[]): void {
    const ranks = ranksOf(loose);
    const piled = ranks.map((_, rank) => loose[ranks.indexOf(rank)]);
    const papers = piled.map((sheet) => sheet.papers?.papersOf(sheet) ?? []);
    const folded = leaves.map((leaf) => leaf.papers?.flapsOf(leaf) ?? []);
    for (const { page } of [this.#left, this.#right]) {
      page.mesh.material.lay(shading([...folded, ...papers].flat(), page));
    }
    for (const [k, leaf] of sheets.entries()) {
      let over: readonly Paper[] = [];
      if (lying.includes(leaf)) {
        // Of those on a side, the ones farther out in the row of leaves lie over it.
        const left = leaf.positions.reduce((sum, x, at) => (at % 3 === 0 ? sum + x : sum), 0) < 0;
        const flaps = folded.filter((_, other) => (left ? other > k : other < k));
        over = shading([...flaps, ...papers].flat(), leaf);
      }
      this.#leaves[k].shadeBy(over);
    }
    for (const [rank, sheet] of piled.entries()) {
      const over = shading(papers.slice(rank + 1).flat(), sheet);
      this.#loose[ranks.indexOf(rank)].shadeBy(over);
    }
    this.#ground.lay(piled.flatMap((sheet) => sheet.papers?.papersOf(sheet, true) ?? []));
  }

  #placeSide(side: DrawnSide, pile: BookPose["left"]): boolean {
    if (!side.pile.update(pile, this.#case, this.#hard)) return false;
    side.page.mesh.visible = side.block.mesh.visible = side.pile.present;
    if (side.pile.present) {
      side.page.shape(side.pile);
      side.block.shape(side.pile);
    }
    return true;
  }

  #placeStaples(pose: BookPose): void {
    if (!this.#staples) return;
    const { mesh } = this.#staples;
    mesh.visible = showsStaples(this.#shape, pose);
    if (mesh.visible) this.#staples.lie([this.#left.pile, this.#right.pile], this.#shape.width);
  }

  #placeBoards(): void {
    const shape = this.#case;
    const [left, right] = [this.#left, this.#right];
    this.#front.place(shape.frontHinge, shape.frontAngle);
    this.#back.place(shape.backHinge, shape.backAngle);
    this.#spine.shape(shape);
    this.#headbands.shape(shape);
    // Under a nearly closed board the fold is not visible, and would stick out at the hinge.
    left.fold.mesh.visible = !left.pile.present && shape.frontAngle > 1.2;
    right.fold.mesh.visible = !right.pile.present && shape.backAngle < Math.PI - 1.2;
    for (const { fold } of [left, right]) {
      if (fold.mesh.visible) fold.shape(shape, left.pile, right.pile);
    }
    const reach = this.#shape.width + caseSizes.rim - caseSizes.joint;
    tipOf(right.over.board, shape.frontHinge, shape.frontAngle, reach, 1);
    tipOf(left.over.board, shape.backHinge, shape.backAngle, reach, -1);
    const edges = this.framing.boardEdges;
    [edges[0], edges[1]] = [right.over.board[2], right.over.board[3]];
    [edges[2], edges[3]] = [-left.over.board[2], left.over.board[3]];
  }

  #light({ pose, sheets, pilesMoved, still }: UnlitPose): void {
    const { leaves, lying = [], flap = null } = pose;
    const [left, right] = [this.#left, this.#right];
    this.#lightLeaves(sheets, flap);
    if (this.#isDim) return;
    // The outermost leaf on a side is nearest to its page.
    // One that lies creased on it hides it, but for what is folded away, and throws no shadow.
    const over = leaves.filter((leaf) => !lying.includes(leaf)).map((leaf) => cutOff(leaf));
    castOver(left.over, left.pile, nextTo(Side.left, over));
    castOver(right.over, right.pile, nextTo(Side.right, over));
    if (left.pile.present) {
      if (pilesMoved) left.page.open(left.pile, right.pile.mirrored);
      left.page.light(left.pile, left.over);
    }
    if (right.pile.present) {
      if (pilesMoved) right.page.open(right.pile, left.pile.obstacles);
      right.page.light(right.pile, right.over);
    }
    if (!this.#hard) return;
    // A board under pages shows only its rim, which no leaf shades.
    const [l, r] = [left.pile, right.pile];
    if (!still || !l.present) this.#front.light(this.#case, l, r, left.over);
    if (!still || !r.present) this.#back.light(this.#case, l, r, right.over);
  }
}

function areSame(some: readonly Surface[], others: readonly Surface[]): boolean {
  return some.length === others.length && some.every((one, k) => one === others[k]);
}

/** Returns the place of each loose sheet among them from the table up: those of one layer lie as they are listed. */
function ranksOf(sheets: readonly Surface[]): number[] {
  const layer = (k: number): number => sheets[k].layer ?? 0;
  const order = [...sheets.keys()].sort((a, b) => layer(a) - layer(b) || a - b);
  return sheets.map((_, k) => order.indexOf(k));
}

/**
 * Writes hinge and outer edge of a board that stands over the pages, as points
 * that block light.
 */
function tipOf(
  out: Float32Array,
  hinge: readonly [number, number],
  angle: number,
  reach: number,
  sign: 1 | -1,
): void {
  out[0] = sign * hinge[0];
  out[1] = hinge[1];
  out[2] = sign * (hinge[0] + reach * Math.cos(angle));
  out[3] = hinge[1] + reach * Math.sin(angle);
}
