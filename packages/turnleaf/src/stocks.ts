/** Written from engine/src/stock.rs: `UPDATE_GOLDEN=1 cargo test -p turnleaf-engine --test preset_stocks`. */

/**
 * The preset stocks, from the lightest to the heaviest, board the last; the engine counts them in this
 * order. Mass per area, kg/m²; thickness, m; bending stiffness along and across the grain, N m; friction.
 */
export const presetStocks = {
  bible: {
    grammage: 0.03,
    caliper: 0.00004,
    stiffnessAlong: 0.00002475,
    stiffnessAcross: 0.000011,
    friction: 0.5,
  },
  book: {
    grammage: 0.07,
    caliper: 0.00009,
    stiffnessAlong: 0.00027,
    stiffnessAcross: 0.00012,
    friction: 0.5,
  },
  office: {
    grammage: 0.08,
    caliper: 0.000104,
    stiffnessAlong: 0.00042750000000000004,
    stiffnessAcross: 0.00019,
    friction: 0.5,
  },
  coated: {
    grammage: 0.17,
    caliper: 0.00014,
    stiffnessAlong: 0.0018000000000000002,
    stiffnessAcross: 0.0008,
    friction: 0.4,
  },
  card: {
    grammage: 0.25,
    caliper: 0.0003,
    stiffnessAlong: 0.010124999999999999,
    stiffnessAcross: 0.0045,
    friction: 0.45,
  },
  board: {
    grammage: 1,
    caliper: 0.0016,
    stiffnessAlong: 1.53,
    stiffnessAcross: 0.68,
    friction: 0.45,
  },
} as const;
