"""A hanging page as a cloth of NVIDIA's Newton, stepped by vertex block descent.

SolverVBD minimises the energy of an implicit Euler step by sweeps over the vertices, each moved
by one Newton step of its own 3 x 3 block (Chen, Liu, Yang and Yuksel, Vertex Block Descent, ACM
Transactions on Graphics 43, 2024). It starts where the page would fall freely. Paper is a mesh of
triangles with a membrane (stable Neo-Hookean) and a hinge on every inner edge.

A hinge of length L (m) that is bent by an angle a (rad) has the energy k L a^2 / 2 with k =
`edge_ke`, so k is in N: a moment a length a radian. A row of hinges dx apart, bent to a curvature
c, turns by a = c dx at each; that is a plate's energy D c^2 / 2 an area if k = D / dx. A hinge has
no Poisson's ratio.
"""

import os

# One thread, as the other engines have.
os.environ["OMP_NUM_THREADS"] = "1"

import newton
import numpy as np
import warp as wp

wp.config.log_level = wp.LOG_WARNING

# Seconds of a frame.
FRAME = 1 / 60


@wp.kernel
def slow_down(kept: float, velocities: wp.array[wp.vec3]):
    """Multiplies velocities by the fraction that a substep leaves of them."""
    vertex = wp.tid()
    velocities[vertex] = velocities[vertex] * kept


def page_mesh(page):
    """Returns vertices (m) and triangles of a page, with a column of vertices behind the spine.

    Diagonals lean the other way in every second row of cells. If all lean one way, a bend comes
    with a twist, and the page hangs askew and too low; if they alternate like a chessboard, half
    of the vertices bend without a hinge.
    """
    columns = page["columns"] + 1
    dx = page["width"] / (page["columns"] - 1)
    dy = page["height"] / (page["rows"] - 1)
    rows, across = np.mgrid[: page["rows"], :columns]
    vertices = np.stack([(across - 1) * dx, rows * dy, 0.0 * rows], axis=-1).reshape(-1, 3)
    triangles = []
    for row in range(page["rows"] - 1):
        for column in range(columns - 1):
            here = row * columns + column
            above = here + columns
            if row % 2 == 0:
                triangles += [(here, here + 1, above + 1), (here, above + 1, above)]
            else:
                triangles += [(here, here + 1, above), (here + 1, above + 1, above)]
    return vertices, triangles


def node_masses(page):
    """Returns each vertex's mass, kg: of the paper about it, 0 for one that is fixed."""
    columns = page["columns"] + 1
    dx = page["width"] / (page["columns"] - 1)
    dy = page["height"] / (page["rows"] - 1)
    across = np.full(columns, dx)
    across[:2] = 0
    across[-1] = dx / 2
    along = np.full(page["rows"], dy)
    along[[0, -1]] = dy / 2
    return page["grammage"] * np.outer(along, across).ravel()


def hinge_factor(page, start, end):
    """Returns the part of `edge_ke` that the edge between two vertices has.

    Newton holds no slope, so a second column of fixed vertices lies behind the spine. The hinge on
    the spine bends half a cell of paper: twice the stiffness.
    """
    columns = page["columns"] + 1
    return 2 if start % columns == 1 and end % columns == 1 else 1


class HangingPage:
    """The page, clamped level along its spine (x = 0), flat at first.

    page: width, height (m), columns, rows, grammage (kg/m^2). how: bending (`edge_ke`, N), stretch
    (`tri_ke` and `tri_ka`, N/m), substeps of a frame, iterations of a substep, damping (1/s).
    """

    def __init__(self, page, how, gravity):
        self.page = page
        vertices, triangles = page_mesh(page)
        builder = newton.ModelBuilder(gravity=(0.0, 0.0, -gravity))
        builder.add_cloth_mesh(
            pos=wp.vec3(),
            rot=wp.quat_identity(),
            scale=1.0,
            vel=wp.vec3(),
            vertices=[wp.vec3(*vertex) for vertex in vertices],
            indices=[vertex for triangle in triangles for vertex in triangle],
            density=page["grammage"],
            tri_ke=how["stretch"],
            tri_ka=how["stretch"],
            tri_kd=0.0,
            edge_ke=how["bending"],
            edge_kd=0.0,
            particle_radius=1e-4,
        )
        builder.particle_mass[:] = node_masses(page).tolist()
        for edge, (_, _, start, end) in enumerate(builder.edge_indices):
            stiffness, damping = builder.edge_bending_properties[edge]
            factor = hinge_factor(page, start, end)
            builder.edge_bending_properties[edge] = (factor * stiffness, damping)
        builder.color(include_bending=True)
        self.model = builder.finalize(device="cpu")
        self.solver = newton.solvers.SolverVBD(
            self.model, iterations=how["iterations"], particle_enable_tile_solve=False
        )
        self.state = self.model.state()
        self.other = self.model.state()
        self.control = self.model.control()
        self.substeps = how["substeps"]
        self.kept = max(0.0, 1 - how["damping"] * FRAME / self.substeps)
        self._record()

    def _record(self):
        """Records a frame's launches, which are then replayed without Python: half of the time."""
        self._launch()
        with wp.ScopedCapture(device="cpu") as capture:
            self._launch()
        self.recording = capture.graph

    def _launch(self):
        now, after = self.state, self.other
        for _ in range(self.substeps):
            velocities = now.particle_qd
            wp.launch(slow_down, len(velocities), [self.kept, velocities], device="cpu")
            self.solver.step(now, after, self.control, None, FRAME / self.substeps)
            now, after = after, now
        if now is not self.state:
            wp.copy(self.state.particle_q, now.particle_q)
            wp.copy(self.state.particle_qd, now.particle_qd)

    def frame(self):
        """Simulates one sixtieth of a second on the calling thread."""
        wp.capture_launch(self.recording)

    def places(self):
        """Returns the vertices' places (m) by row and column, those behind the spine left out."""
        places = self.state.particle_q.numpy().astype(float)
        return places.reshape(self.page["rows"], self.page["columns"] + 1, 3)[:, 1:]

    def tip(self):
        """Returns how far the fore-edge reaches and hangs, over the page's width."""
        x, _, z = self.places()[:, -1].mean(axis=0) / self.page["width"]
        return {"reach": x, "drop": -z}

    def strain(self):
        """Returns the greatest strain of an edge across the page."""
        lengths = np.linalg.norm(np.diff(self.places(), axis=1), axis=2)
        return float(lengths.max() * (self.page["columns"] - 1) / self.page["width"] - 1)


def small_deflection(page, bending, gravity):
    """Returns the drop (over the width) at which these hinges hold a page that hardly bends.

    Solved directly, so that what is off is the mesh's error and none of the solver's. The exact
    one is Gamma / 8.
    """
    vertices, triangles = page_mesh(page)
    opposite = {}
    for triangle in triangles:
        for corner in range(3):
            edge = tuple(sorted((triangle[corner], triangle[(corner + 1) % 3])))
            opposite.setdefault(edge, []).append(triangle[(corner + 2) % 3])
    stiffness = np.zeros((len(vertices), len(vertices)))
    for (start, end), tops in opposite.items():
        if len(tops) < 2:
            continue
        edge = vertices[end] - vertices[start]
        length = np.linalg.norm(edge)
        # How the angle depends on the heights of the four vertices.
        angle = np.zeros(len(vertices))
        for top in tops:
            arm = vertices[top] - vertices[start]
            along = arm @ edge / length**2
            height = np.linalg.norm(arm - along * edge)
            angle[top] += 1 / height
            angle[start] -= (1 - along) / height
            angle[end] -= along / height
        hinge = bending * hinge_factor(page, start, end) * length
        stiffness += hinge * np.outer(angle, angle)
    masses = node_masses(page)
    free = masses > 0
    heights = np.zeros(len(vertices))
    heights[free] = np.linalg.solve(stiffness[np.ix_(free, free)], gravity * masses[free])
    return float(heights.reshape(page["rows"], -1)[:, -1].mean() / page["width"])
