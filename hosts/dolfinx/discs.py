"""Two discs of triangles, or cylinders of tetrahedra, as points and cells of both."""
import numpy as np


def slipping_discs(dim, rings):
    """Points (n, dim), cells (m, dim + 1), how many of them are the left disc's, and both centres (2, dim). Radius 1, in 3D
    length 1; ring r has 6 r points."""
    centres = np.array([[0.0, 0.0, 0.0], [np.sqrt(2.02**2 - 0.8**2), 0.8, 0.0]])[:, :dim]
    discs = [_disc(rings, turn) for turn in (0.0, 0.1)]
    if dim == 3:
        discs = [_extruded(*disc, rings) for disc in discs]
    (x_left, left), (x_right, right) = discs
    return np.vstack([x_left + centres[0], x_right + centres[1]]), np.vstack([left, right + len(x_left)]), len(left), centres


def _disc(rings, turn):
    def point(r, k):
        return 0 if r == 0 else 1 + 3 * r * (r - 1) + k % (6 * r)
    x = [(0.0, 0.0)] + [(r / rings * np.cos(a), r / rings * np.sin(a))
                        for r in range(1, rings + 1) for a in 2 * np.pi * np.arange(6 * r) / (6 * r) + turn]
    cells = []
    for r in range(1, rings + 1):
        for out in range(6 * r):
            side, k = divmod(out, r)
            inner = side * (r - 1) + k
            cells.append([point(r - 1, inner), point(r, out), point(r, out + 1)])
            if k < r - 1:
                cells.append([point(r - 1, inner), point(r, out + 1), point(r - 1, inner + 1)])
    return np.array(x), np.array(cells)


def _extruded(x, triangles, layers):
    n, (a, b, c) = len(x), np.sort(triangles).T  # corners of all prisms in the same order: their diagonals meet
    prism = np.vstack([np.column_stack(t) for t in ((a, b, c, c + n), (a, b, b + n, c + n), (a, a + n, b + n, c + n))])
    return (np.vstack([np.column_stack([x, np.full(n, z)]) for z in np.linspace(-0.5, 0.5, layers + 1)]),
            np.vstack([prism + layer * n for layer in range(layers)]))
