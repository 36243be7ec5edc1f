"""A hanging page by Newton's vertex block descent on the processor: cost of a frame, and error.

    make bench-hanging
    target/newton/bin/python bench/peers/vbd_sheet.py [--write]

Prints JSON; --write keeps it in bench/results/vbd-sheet.json. The page, its load, what counts as
motionless and what is good enough are those of jolt_sheet.mjs. Takes some ten minutes of a
processor's time. How to read it: bench/README.md.
"""

import csv
import json
import math
import platform
import re
import subprocess
import sys
import time
from importlib.metadata import version
from pathlib import Path

try:
    import vbd
except ModuleNotFoundError as missing:
    said = f"Newton is left out: Python has no {missing.name}; see bench/README.md."
    raise SystemExit(said) from None

ROOT = Path(__file__).resolve().parents[2]
PAGE = {"width": 0.148, "height": 0.21, "columns": 12, "rows": 16, "grammage": 0.07}
GRIDS = [(7, 9), (12, 16), (17, 23)]
GAMMA = 10
ALLOWED = 0.02
SECOND = 60
LONGEST_SETTLING = 20
MOTIONLESS = 1e-5
STOCK = (ROOT / "engine/src/stock.rs").read_text()
GRAVITY = float(re.search(r"const GRAVITY: f64 = ([\d.]+);", STOCK)[1])

# Damping as in jolt_sheet.mjs, 1/s.
DAMPING = 5
# Membrane of the page, N/m: soft enough that the sweeps converge, stiff enough that it stretches
# by half a percent. Stiffer ones are tried with STRETCHED.
STRETCH = 10
STIFFER = [100, 1000]
STRETCHED = (40, 5)
# Substeps of a frame and iterations of each.
CONVERGED = (40, 10)
SCHEDULES = [
    *[(4, 10), (4, 50), (10, 4), (10, 10), (20, 2), (20, 5)],
    *[(40, 2), (40, 3), (40, 5), CONVERGED, (80, 2)],
]
# Where the stiffness is fitted, and the stiffest that is tried, over the paper's.
FITTED = [
    *[(4, 10), (10, 4), (10, 10), (20, 2), (20, 5), (40, 1)],
    *[(5, 4), (8, 3), (10, 1), (10, 2), (20, 1)],
]
STIFFEST = 300
# Schedules of the other grids.
OTHER_GRIDS = {(7, 9): [(10, 4), (20, 2), (20, 5), (40, 5)], (17, 23): [(40, 5)]}


def exact_tip(gamma):
    """Returns the exact reach and drop of the clamped strip, over its length."""
    with open(ROOT / "engine/tests/anchors/heavy_elastica.csv") as file:
        for row in csv.DictReader(file):
            if float(row["Gamma"]) == gamma:
                return {"reach": float(row["W"]), "drop": float(row["H"])}
    raise SystemExit(f"engine/tests/anchors/heavy_elastica.csv has no row of {gamma}.")


def on_grid(grid):
    """Returns the page with other numbers of columns and rows."""
    return {**PAGE, "columns": grid[0], "rows": grid[1]}


def paper_bending(page):
    """Returns the stiffness of this mesh's hinges by the paper's bending stiffness, N."""
    stiffness = page["grammage"] * GRAVITY * page["width"] ** 3 / GAMMA
    return stiffness * (page["columns"] - 1) / page["width"]


def settle(page, how, gamma=GAMMA):
    """Hangs a page until it is motionless: within 1e-5 of its width in a second."""
    sheet = vbd.HangingPage(page, how, GRAVITY * gamma / GAMMA)
    exact = exact_tip(gamma)
    now, moved, seconds = sheet.tip(), math.inf, 0
    while seconds < LONGEST_SETTLING and moved > MOTIONLESS:
        before = now
        for _ in range(SECOND):
            sheet.frame()
        seconds += 1
        now = sheet.tip()
        moved = max(abs(now[key] - before[key]) for key in now)
    row = {
        "columns": page["columns"],
        "rows": page["rows"],
        "gamma": gamma,
        **how,
        **now,
        "dropError": now["drop"] / exact["drop"] - 1,
        "reachError": now["reach"] / exact["reach"] - 1,
        "strain": sheet.strain(),
        "frames": seconds * SECOND,
        "moved": moved,
        "motionless": bool(moved <= MOTIONLESS),
    }
    note = f"{row['substeps']} x {row['iterations']}, {how['bending']:.4f} N, {how['stretch']} N/m"
    errors = f"drop {row['dropError']:+.4f}, reach {row['reachError']:+.4f}"
    print(f"{note}: {errors}, {seconds} s", file=sys.stderr, flush=True)
    return sheet, row


def settings(page, schedule, factor=1.0, stretch=STRETCH):
    """Returns the settings of a schedule with hinges of `factor` times the paper's stiffness."""
    return {
        "bending": factor * paper_bending(page),
        "stretch": stretch,
        "substeps": schedule[0],
        "iterations": schedule[1],
        "damping": DAMPING,
    }


def fit_stiffness(schedule, trials=7):
    """Returns the page whose drop is right at this schedule, by the secant rule on logarithms."""
    factors, errors, best = [1.0], [], None
    for _ in range(trials):
        sheet, row = settle(PAGE, settings(PAGE, schedule, factors[-1]))
        errors.append(row["dropError"])
        if best is None or abs(row["dropError"]) < abs(best[1]["dropError"]):
            best = sheet, row
        if abs(row["dropError"]) < ALLOWED / 20 or not math.isfinite(row["dropError"]):
            break
        # At this load the drop goes with the power -0.3 of the stiffness, if all is solved.
        slope = -0.3
        if len(errors) > 1 and errors[-1] != errors[-2]:
            slope = (errors[-1] - errors[-2]) / math.log(factors[-1] / factors[-2])
        step = max(-2.0, min(2.0, -errors[-1] / min(slope, -0.03)))
        factors.append(min(STIFFEST, factors[-1] * math.exp(step)))
        if factors[-1] == factors[-2]:
            break
    return best


def search():
    """Returns all that was tried, as pairs of a page and its row."""
    found = []

    def add(stiffness, pair):
        sheet, row = pair
        factor = row["bending"] / paper_bending(on_grid((row["columns"], row["rows"])))
        found.append((sheet, {"stiffness": stiffness, **row, "factor": factor}))

    for schedule in SCHEDULES:
        add("paper", settle(PAGE, settings(PAGE, schedule)))
    for schedule in FITTED:
        add("fitted", fit_stiffness(schedule))
    for stretch in STIFFER:
        add("paper", settle(PAGE, settings(PAGE, STRETCHED, stretch=stretch)))
    for grid, schedules in OTHER_GRIDS.items():
        for schedule in schedules:
            add("paper", settle(on_grid(grid), settings(on_grid(grid), schedule)))
    return found


def worst(row):
    """Returns the greater error of drop and reach."""
    error = max(abs(row["dropError"]), abs(row["reachError"]))
    return error if math.isfinite(error) else math.inf


def cost(row):
    """Returns how many times a frame moves a vertex: what its time goes with."""
    return row["substeps"] * row["iterations"] * row["columns"] * row["rows"]


def choose(found):
    """Returns the cheapest within what is allowed, else the nearest."""
    good = [pair for pair in found if worst(pair[1]) <= ALLOWED]
    if good:
        return min(good, key=lambda pair: cost(pair[1]))
    return min(found, key=lambda pair: worst(pair[1]))


def spread(values):
    """Returns the median and the 5th and 95th percentile."""
    values = sorted(values)

    def at(part):
        return values[math.floor(part * (len(values) - 1))]

    return at(0.5), at(0.05), at(0.95)


def our_time():
    """Returns the processor's time of a frame of the engine's sheet, us, or None without it."""
    script = ROOT / "bench/peers/our_sheet.mjs"
    try:
        printed = subprocess.run(["node", script], capture_output=True, text=True, check=True)
        return json.loads(printed.stdout)["cpu_us"]
    except (OSError, subprocess.CalledProcessError, KeyError, json.JSONDecodeError):
        return None


def time_frames(sheets, batches=21, frames=2):
    """Returns the processor's time of a frame of each page, batches taken in turn.

    The time of the whole process, so that threads would be counted, and other programs are not.
    """
    times = [[] for _ in sheets]
    walls = [[] for _ in sheets]
    ours = []
    for batch in range(batches):
        if batch % 5 == 0:
            ours.append(our_time())
        for sheet, processor, wall in zip(sheets, times, walls, strict=True):
            start = time.process_time(), time.perf_counter()
            for _ in range(frames):
                sheet.frame()
            if batch > 0:
                processor.append(1e3 * (time.process_time() - start[0]) / frames)
                wall.append(1e3 * (time.perf_counter() - start[1]) / frames)
    known = [value for value in ours if value is not None]
    our_us = spread(known)[0] if known else None
    rows = []
    for processor, wall in zip(times, walls, strict=True):
        median, low, high = spread(processor)
        row = {"cpu_ms": median, "p5_ms": low, "p95_ms": high, "least_wall_ms": min(wall)}
        if our_us:
            row["timesOurs"] = 1e3 * median / our_us
        rows.append(row)
    return rows, our_us


def processor_name():
    """Returns the name of the processor, where Linux says it."""
    try:
        return re.search(r"model name\s*:\s*(.+)", Path("/proc/cpuinfo").read_text())[1]
    except (OSError, TypeError):
        return platform.processor()


def mesh_checks():
    """Returns the error of small deflection that each grid's mesh has, and that the solver has."""
    gamma = 0.1
    rows = []
    for grid in GRIDS:
        page = on_grid(grid)
        gravity = GRAVITY * gamma / GAMMA
        drop = vbd.small_deflection(page, paper_bending(page), gravity)
        rows.append({"columns": grid[0], "rows": grid[1], "meshError": drop / (gamma / 8) - 1})
    _, solved = settle(PAGE, settings(PAGE, CONVERGED), gamma)
    return {"gamma": gamma, "meshes": rows, "solved": solved}


def main():
    checks = mesh_checks()
    found = search()
    same_grid = [pair for pair in found if (pair[1]["columns"], pair[1]["rows"]) == (12, 16)]
    paper = [pair for pair in same_grid if pair[1]["stiffness"] == "paper"]
    fitted = [pair for pair in same_grid if pair[1]["stiffness"] == "fitted"]
    chosen = [
        ("VBD, stiffness of the paper", choose(paper)),
        ("VBD, stiffness fitted to this load", choose(fitted)),
    ]
    pairs = [pair for _, pair in chosen] + found
    times, our_us = time_frames([sheet for sheet, _ in pairs])
    timed = [{**row, **measured} for (_, row), measured in zip(pairs, times, strict=True)]
    named = [{"name": name, **row} for (name, _), row in zip(chosen, timed, strict=False)]
    other_loads = []
    for _, (_, row) in chosen:
        how = {key: row[key] for key in settings(PAGE, CONVERGED)}
        for gamma in (1, 25):
            _, other = settle(PAGE, how, gamma)
            other_loads.append({"stiffness": row["stiffness"], **other})
    results = {
        "peer": f"newton {version('newton')}, SolverVBD",
        "warp": f"warp-lang {version('warp-lang')}, on the processor, one thread",
        "python": platform.python_version(),
        "processor": processor_name(),
        "page": {**PAGE, "gamma": GAMMA},
        "exact": exact_tip(GAMMA),
        "allowed": ALLOWED,
        "ours_us": our_us,
        "checks": checks,
        "timed": named,
        "otherLoads": other_loads,
        "tried": timed[len(chosen) :],
    }
    # Exponents as JavaScript writes them, which the formatter asks for.
    text = re.sub(r"e-0(\d)", r"e-\1", json.dumps(finite(results), indent=2))
    if "--write" in sys.argv:
        (ROOT / "bench/results/vbd-sheet.json").write_text(f"{text}\n")
    print(text)


def finite(value):
    """Returns the value with null for numbers that JSON does not have."""
    if isinstance(value, dict):
        return {key: finite(part) for key, part in value.items()}
    if isinstance(value, list):
        return [finite(part) for part in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


if __name__ == "__main__":
    main()
