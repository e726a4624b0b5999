/* write_scene <scene> <friction>: two cubes of 4 x 4 quadrangles a side; the upper one presses, slides, turns, wobbles, leaves and
   comes again. All drivers read the same doubles, so that no sine of a language differs.

   Little-endian: int32 nodes, faces and steps; int32 corners[faces][4] and body[faces], from 0; doubles depth[faces],
   stiffness[2], shear_stiffness[2], friction and positions[steps + 1][nodes][3]. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

enum { side = 4, edge = side + 1, cube_nodes = edge * edge * edge, cube_faces = 6 * side * side };
enum { n_nodes = 2 * cube_nodes, n_faces = 2 * cube_faces, n_steps = 200 };

static int32_t node(int cube, const int at[3]) { return cube * cube_nodes + at[0] + edge * (at[1] + edge * at[2]); }

/* The corner (s, t) of a side of a cube, normal to `axis`, whose outside is up or down the axis. */
static int32_t corner(int cube, int axis, int up, int s, int t) {
    int at[3];
    at[axis] = up ? side : 0;
    at[(axis + (up ? 1 : 2)) % 3] = s;
    at[(axis + (up ? 2 : 1)) % 3] = t;
    return node(cube, at);
}

int main(int argc, char** argv) {
    FILE* file = argc == 3 ? fopen(argv[1], "wb") : NULL;
    if (file == NULL) return perror("write_scene <scene> <friction>"), 1;
    static int32_t corners[n_faces][4], body[n_faces];
    static double depth[n_faces], x[n_nodes][3];
    int face = 0;
    for (int cube = 0; cube < 2; ++cube)
        for (int axis = 0; axis < 3; ++axis)
            for (int up = 0; up < 2; ++up)
                for (int i = 0; i < side * side; ++i, ++face) {
                    const int s = i % side, t = i / side;
                    corners[face][0] = corner(cube, axis, up, s, t);
                    corners[face][1] = corner(cube, axis, up, s + 1, t);
                    corners[face][2] = corner(cube, axis, up, s + 1, t + 1);
                    corners[face][3] = corner(cube, axis, up, s, t + 1);
                    body[face] = cube;
                    depth[face] = 0.5 / side;
                }
    const int32_t head[3] = {n_nodes, n_faces, n_steps};
    const double stiffness[2] = {3.0, 6.0}, shear_stiffness[2] = {1.0, 2.0}, friction = atof(argv[2]);
    fwrite(head, sizeof(head), 1, file);
    fwrite(corners, sizeof(corners), 1, file);
    fwrite(body, sizeof(body), 1, file);
    fwrite(depth, sizeof(depth), 1, file);
    fwrite(stiffness, sizeof(stiffness), 1, file);
    fwrite(shear_stiffness, sizeof(shear_stiffness), 1, file);
    fwrite(&friction, sizeof(friction), 1, file);
    for (int step = 0; step <= n_steps; ++step) {
        const double t = 6.283185307179586 * step / n_steps;
        for (int i = 0; i < n_nodes; ++i) {
            const int j = i % cube_nodes;
            double* p = x[i];
            for (int d = 0, k = j; d < 3; ++d, k /= edge) p[d] = (double)(k % edge) / side;
            if (i < cube_nodes) continue;
            const double a = p[0] - 0.5, b = p[1] - 0.5, turn = 1.5 * sin(0.5 * t), tilt = 0.04 * sin(2.0 * t);
            p[0] = 0.5 + 0.3 * sin(t) + a * cos(turn) - b * sin(turn);
            p[1] = 0.5 + 0.2 * sin(2.0 * t) + a * sin(turn) + b * cos(turn);
            p[2] += 1.02 - 0.07 * sin(3.0 * t) + tilt * a + 0.005 * sin(5.0 * t + 4.0 * b);
        }
        fwrite(x, sizeof(x), 1, file);
    }
    return ferror(file) || fclose(file) ? 1 : 0;
}
