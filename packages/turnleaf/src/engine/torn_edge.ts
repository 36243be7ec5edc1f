/** How paper looks where it is torn: the shader of paper draws it so, and its shadow ends there. Lengths in metres. */
export const tornEdge = {
  /**
   * The line of the edge, a coarse and a fine noise: how deep each is at most, and how far its values are apart.
   * Across a page the line wanders by half of both depths to either side of the tear, and so less than
   * `BEYOND` of the engine's `models/sheet/torn.rs`, by which either piece is drawn beyond it.
   */
  coarse: { depth: 0.0012, apart: 0.005 },
  fine: { depth: 0.0005, apart: 0.0009 },
  /** How far fibres are bared: at the spine, and across a page on the side of the paper with more of them, and with fewer. */
  bared: { atSpine: 0.0012, more: 0.0022, fewer: 0.0009 },
  /** How wide a tuft of fibres is: the next one is of another length. */
  tuft: 0.0006,
  /** Red, green and blue of fibres as multiples of bare paper's, and how much of the print they hide, 0 to 1. */
  colour: [1.02, 1.06, 1.15],
  cover: 0.8,
} as const;

/** How far within the paper's edge it is torn on average, metres. */
export const meanTornDepth: number = (tornEdge.coarse.depth + tornEdge.fine.depth) / 2;
