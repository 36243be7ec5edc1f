/**
 * A hanging sheet as a soft body of Jolt Physics.
 *
 * A grid of triangles whose edges and diagonals do not give. Jolt steps it by
 * XPBD: an update is `iterations` substeps of one sweep over the constraints.
 */
import { createRequire } from "node:module";

const LAYER = 0;
/** Seconds of a frame. */
export const FRAME = 1 / 60;

/** The two release builds of the package: with SIMD it comes only with threads. */
const BUILDS = { plain: "jolt-physics/wasm", simd: "jolt-physics/wasm-multithread" };

/**
 * The threaded build waits in Node for workers that never answer. A soft body
 * is stepped on the calling thread and needs none, so workers that only say
 * that they are there will do.
 */
function standInForWorkers() {
  const threads = createRequire(import.meta.url)("node:worker_threads");
  const { Worker } = threads;
  const loaded = 3;
  threads.Worker = class {
    postMessage(message) {
      const [command] = Object.keys(message);
      queueMicrotask(() => this.onmessage?.({ data: { [command]: loaded } }));
    }
    on() {}
    unref() {}
  };
  return () => {
    threads.Worker = Worker;
  };
}

/** A build of Jolt, "plain" or "simd", with a world of no other bodies. */
export async function loadJolt(build) {
  const { default: create } = await import(BUILDS[build]);
  const restore = standInForWorkers();
  const Jolt = await create();
  restore();
  const settings = new Jolt.JoltSettings();
  settings.mMaxWorkerThreads = 0;
  const layers = 1;
  settings.mObjectLayerPairFilter = new Jolt.ObjectLayerPairFilterTable(layers);
  const broad = new Jolt.BroadPhaseLayerInterfaceTable(layers, layers);
  const layer = new Jolt.BroadPhaseLayer(0);
  broad.MapObjectToBroadPhaseLayer(LAYER, layer);
  Jolt.destroy(layer);
  settings.mBroadPhaseLayerInterface = broad;
  settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(
    broad,
    layers,
    settings.mObjectLayerPairFilter,
    layers,
  );
  const world = new Jolt.JoltInterface(settings);
  Jolt.destroy(settings);
  return { Jolt, world, system: world.GetPhysicsSystem() };
}

/**
 * The page as a soft body, clamped level along its spine (x = 0), flat at first.
 *
 * page: { width, height (m), columns, rows, grammage (kg/m^2) }.
 * how: { bend, compliance, iterations, updates, damping (1/s), attachments, gravity (m/s^2) }.
 * Bending is by "dihedral" angles or by the "distance" between opposite corners.
 * Compliance is of one such constraint: 1/(N m), or m/N. Attachments, if asked
 * for, keep every vertex within its distance from the clamp.
 *
 * Jolt holds no slope, so one column of fixed vertices lies behind the spine.
 * The hinge on the spine bends half a cell of paper: half the compliance.
 */
export function hangSheet({ Jolt, system }, page, how) {
  const columns = page.columns + 1;
  const dx = page.width / (page.columns - 1);
  const dy = page.height / (page.rows - 1);
  const at = (column, row) => row * columns + column;
  const shared = new Jolt.SoftBodySharedSettings();
  addVertices();
  addFaces();
  constrain();
  shared.Optimize();
  const body = place();
  const motion = Jolt.castObject(body.GetMotionProperties(), Jolt.SoftBodyMotionProperties);
  const updates = how.updates ?? 1;

  function addVertices() {
    const vertex = new Jolt.SoftBodySharedSettingsVertex();
    for (let row = 0; row < page.rows; row++) {
      for (let column = 0; column < columns; column++) {
        const across = column === columns - 1 ? 0.5 : 1;
        const along = row === 0 || row === page.rows - 1 ? 0.5 : 1;
        const position = new Jolt.Float3((column - 1) * dx, row * dy, 0);
        vertex.mPosition = position;
        vertex.mInvMass = column < 2 ? 0 : 1 / (page.grammage * dx * dy * across * along);
        shared.mVertices.push_back(vertex);
        Jolt.destroy(position);
      }
    }
    Jolt.destroy(vertex);
  }

  function addFaces() {
    const add = (...corners) => {
      const face = new Jolt.SoftBodySharedSettingsFace(...corners, 0);
      shared.AddFace(face);
      Jolt.destroy(face);
    };
    for (let row = 0; row + 1 < page.rows; row++) {
      for (let column = 0; column + 1 < columns; column++) {
        const [here, across] = [at(column, row), at(column + 1, row + 1)];
        add(here, at(column + 1, row), across);
        add(here, across, at(column, row + 1));
      }
    }
  }

  function constrain() {
    const attributes = new Jolt.ArraySoftBodySharedSettingsVertexAttributes();
    const one = new Jolt.SoftBodySharedSettingsVertexAttributes();
    one.mCompliance = 0;
    one.mShearCompliance = 0;
    if (how.attachments) one.mLRAType = Jolt.SoftBodySharedSettings_ELRAType_GeodesicDistance;
    for (let row = 0; row < page.rows; row++) {
      for (let column = 0; column < columns; column++) {
        one.mBendCompliance = how.compliance * (column === 1 ? 0.5 : 1);
        attributes.push_back(one);
      }
    }
    const bends = {
      dihedral: Jolt.SoftBodySharedSettings_EBendType_Dihedral,
      distance: Jolt.SoftBodySharedSettings_EBendType_Distance,
    };
    shared.CreateConstraints(attributes.data(), attributes.size(), bends[how.bend]);
    Jolt.destroy(attributes);
    Jolt.destroy(one);
  }

  function place() {
    const gravity = new Jolt.Vec3(0, 0, -how.gravity);
    system.SetGravity(gravity);
    const origin = new Jolt.RVec3(0, 0, 0);
    const level = new Jolt.Quat(0, 0, 0, 1);
    const creation = new Jolt.SoftBodyCreationSettings(shared, origin, level, LAYER);
    creation.mNumIterations = how.iterations;
    creation.mLinearDamping = how.damping;
    creation.mUpdatePosition = false;
    creation.mAllowSleeping = false;
    const bodies = system.GetBodyInterface();
    const made = bodies.CreateSoftBody(creation);
    bodies.AddBody(made.GetID(), Jolt.EActivation_Activate);
    for (const used of [gravity, origin, level, creation]) Jolt.destroy(used);
    return made;
  }

  return {
    /** Simulates one sixtieth of a second on the calling thread. */
    frame() {
      for (let update = 0; update < updates; update++) {
        motion.CustomUpdate(FRAME / updates, body, system);
      }
    },

    /** How far the fore-edge reaches and hangs, as parts of the page's width. */
    tip() {
      const origin = body.GetCenterOfMassPosition();
      let [x, z] = [origin.GetX(), origin.GetZ()];
      for (let row = 0; row < page.rows; row++) {
        const { mPosition } = motion.GetVertex(at(columns - 1, row));
        x += mPosition.GetX() / page.rows;
        z += mPosition.GetZ() / page.rows;
      }
      return { reach: x / page.width, drop: -z / page.width };
    },

    free() {
      const bodies = system.GetBodyInterface();
      bodies.RemoveBody(body.GetID());
      bodies.DestroyBody(body.GetID());
    },
  };
}
