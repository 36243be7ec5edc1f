"""A hanging page by Newton's Vertex Block Descent: cost of a frame, and error.

    python3 -m venv target/newton && target/newton/bin/pip install -r bench/peers/requirements.txt
    target/newton/bin/python bench/peers/newton_sheet.py [--write]

Prints JSON; --write keeps it in bench/results/newton-sheet.json. The page, its load and what is
good enough are those of jolt_sheet.mjs. How to read it: bench/README.md.
"""

import csv
import json
import platform
import re
import statistics
import sys
import time
from pathlib import Path

import newton
import numpy as np
import warp as wp

ROOT = Path(__file__).resolve().parents[2]
PAGE = {"width": 0.148, "height": 0.21, "columns": 12, "rows": 16, "grammage": 0.07}
GAMMA = 10
ALLOWED = 0.02
FRAME = 1 / 60
SECOND = 60
LONGEST_SETTLING = 20 * SECOND
GRAVITY = float(
    re.search(r"const GRAVITY: f64 = ([\d.]+);", (ROOT / "engine/src/stock.rs").read_text())[1]
)

# Substeps of a frame and iterations of each.
SCHEDULES = [(1, 10), (1, 20), (1, 50), (1, 100), (4, 10), (4, 25), (10, 10), (10, 20)]
# Where more of both change little: the bending stiffness is calibrated there.
CONVERGED = (20, 50)
# Stiffness of the mesh against stretch and shear, N/m, and its damping.
STRETCH = 1e3
DAMPING = {"tri": 1e-5, "edge": 1e-3}


def exact_tip():
    """Returns the exact reach and drop of the clamped strip, over its length."""
    with open(ROOT / "engine/tests/anchors/heavy_elastica.csv") as file:
        for row in csv.DictReader(file):
            if float(row["Gamma"]) == GAMMA:
                return {"reach": float(row["W"]), "drop": float(row["H"])}
    raise SystemExit(f"engine/tests/anchors/heavy_elastica.csv has no row of {GAMMA}.")


class HangingPage:
    """A page clamped level along its spine, flat at first.

    Newton holds no slope, so a second column of fixed vertices lies behind the spine.
    """

    def __init__(self, bending, substeps, iterations, stretch=STRETCH):
        columns = PAGE["columns"] + 1
        rows = PAGE["rows"]
        dx = PAGE["width"] / (PAGE["columns"] - 1)
        dy = PAGE["height"] / (rows - 1)
        vertices = [
            wp.vec3((column - 1) * dx, row * dy, 0.0)
            for row in range(rows)
            for column in range(columns)
        ]
        indices = []
        for row in range(rows - 1):
            for column in range(columns - 1):
                here = row * columns + column
                across = here + columns + 1
                indices += [here, here + 1, across, here, across, here + columns]
        builder = newton.ModelBuilder(gravity=-GRAVITY)
        builder.add_cloth_mesh(
            pos=wp.vec3(),
            rot=wp.quat_identity(),
            scale=1.0,
            vel=wp.vec3(),
            vertices=vertices,
            indices=indices,
            density=PAGE["grammage"],
            tri_ke=stretch,
            tri_ka=stretch,
            tri_kd=DAMPING["tri"],
            edge_ke=bending,
            edge_kd=DAMPING["edge"],
            particle_radius=1e-4,
        )
        for row in range(rows):
            for column in range(2):
                builder.particle_mass[row * columns + column] = 0.0
        # The hinge on the spine bends half a cell of paper: twice the stiffness.
        for edge, (_, _, start, end) in enumerate(builder.edge_indices):
            if start % columns == 1 and end % columns == 1:
                ke, kd = builder.edge_bending_properties[edge]
                builder.edge_bending_properties[edge] = (2 * ke, kd)
        builder.color(include_bending=True)
        self.model = builder.finalize(device="cpu")
        self.solver = newton.solvers.SolverVBD(
            self.model, iterations=iterations, particle_enable_tile_solve=False
        )
        self.states = [self.model.state(), self.model.state()]
        self.control = self.model.control()
        self.substeps = substeps
        self.tips = [row * columns + columns - 1 for row in range(rows)]

    def frame(self):
        """Simulates one sixtieth of a second."""
        for _ in range(self.substeps):
            now, after = self.states
            now.clear_forces()
            self.solver.step(now, after, self.control, None, FRAME / self.substeps)
            self.states.reverse()

    def tip(self):
        """Returns how far the fore-edge reaches and hangs, over the page's width."""
        x, _, z = np.mean(self.states[0].particle_q.numpy()[self.tips], axis=0)
        return {"reach": float(x) / PAGE["width"], "drop": float(-z) / PAGE["width"]}


def settle(bending, schedule):
    """Hangs a page until it is motionless: within 1e-5 of its width in a second."""
    page = HangingPage(bending, *schedule)
    exact = exact_tip()
    now, moved, frames = page.tip(), float("inf"), 0
    while frames < LONGEST_SETTLING and moved > 1e-5:
        before = now
        for _ in range(SECOND):
            page.frame()
        frames += SECOND
        now = page.tip()
        moved = max(abs(now[key] - before[key]) for key in now)
    row = {
        "bending": bending,
        "substeps": schedule[0],
        "iterations": schedule[1],
        **now,
        "dropError": now["drop"] / exact["drop"] - 1,
        "reachError": now["reach"] / exact["reach"] - 1,
        "frames": frames,
        "motionless": moved <= 1e-5,
    }
    print(json.dumps(row), file=sys.stderr, flush=True)
    return page, row


def calibrate():
    """Returns the bending stiffness with which the drop is right where more work changes little."""
    dx = PAGE["width"] / (PAGE["columns"] - 1)
    paper = PAGE["grammage"] * GRAVITY * PAGE["width"] ** 3 / GAMMA / dx
    low, high = paper / 4, paper * 4
    rows = []
    for _ in range(6):
        middle = (low * high) ** 0.5
        _, row = settle(middle, CONVERGED)
        rows.append(row)
        if abs(row["dropError"]) < ALLOWED / 20:
            break
        if row["dropError"] > 0:
            low = middle
        else:
            high = middle
    return paper, min(rows, key=lambda row: abs(row["dropError"]))["bending"], rows


def time_frames(pages):
    """Returns microseconds a frame of each page, batches taken in turn."""
    batches = [[] for _ in pages]
    for batch in range(21):
        for page, times in zip(pages, batches, strict=True):
            start = time.perf_counter()
            for _ in range(5):
                page.frame()
            if batch > 0:
                times.append(1e6 * (time.perf_counter() - start) / 5)
    return [
        {
            "median_us": statistics.median(times),
            "p5_us": sorted(times)[1],
            "p95_us": sorted(times)[-2],
        }
        for times in batches
    ]


def main():
    wp.config.quiet = True
    paper, calibrated, tried = calibrate()
    settled = [settle(calibrated, schedule) for schedule in SCHEDULES]
    settled += [settle(paper, schedule) for schedule in SCHEDULES if schedule[0] > 1]
    times = time_frames([page for page, _ in settled])
    rows = [
        {
            "stiffness": "calibrated" if row["bending"] == calibrated else "paper",
            **row,
            **timed,
        }
        for (_, row), timed in zip(settled, times, strict=True)
    ]
    results = {
        "peer": f"newton {newton.__version__}, warp {wp.__version__}, on the processor",
        "python": platform.python_version(),
        "page": {**PAGE, "gamma": GAMMA},
        "exact": exact_tip(),
        "allowed": ALLOWED,
        "stretch": STRETCH,
        "timed": rows,
        "tried": tried,
    }
    text = json.dumps(results, indent=2)
    if "--write" in sys.argv:
        (ROOT / "bench/results/newton-sheet.json").write_text(f"{text}\n")
    print(text)


if __name__ == "__main__":
    main()
