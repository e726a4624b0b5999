/* forces <scene> <file>: follows a scene of write_scene.c from C. Writes for each step the doubles of all forces, W at both
   ends, the number of pairs, energy and dissipation of friction, the number of faces with it; of each pair its faces from 0,
   normal, gaps, area, forces, active share, compression, friction, slip and point; of each face with friction all. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "abut.h"

static void* read_array(FILE* file, size_t size, size_t n) {
    void* data = malloc(size * n);
    if (data == NULL || fread(data, size, n, file) != n) exit(2);
    return data;
}

static void check(int status, const abut_error* error) {
    if (status == ABUT_OK) return;
    fprintf(stderr, "%s\n", error->message);
    exit(1);
}

int main(int argc, char** argv) {
    FILE *in = argc == 3 ? fopen(argv[1], "rb") : NULL, *out = argc == 3 ? fopen(argv[2], "wb") : NULL;
    if (in == NULL || out == NULL) return perror("forces <scene> <file>"), 2;
    int32_t head[3];
    double stiffness[2], shear_stiffness[2];
    abut_options options;
    abut_options_init(&options);
    if (fread(head, sizeof(head), 1, in) != 1) return 2;
    const int64_t n_nodes = head[0], n_faces = head[1];
    int32_t* corners = read_array(in, sizeof(int32_t), 4 * (size_t)n_faces);
    int32_t* body = read_array(in, sizeof(int32_t), (size_t)n_faces);
    double* depth = read_array(in, sizeof(double), (size_t)n_faces);
    if (fread(stiffness, sizeof(stiffness), 1, in) != 1 || fread(shear_stiffness, sizeof(shear_stiffness), 1, in) != 1 ||
        fread(&options.friction, sizeof(double), 1, in) != 1)
        return 2;
    int32_t* offsets = malloc(sizeof(int32_t) * (size_t)(n_faces + 1));
    for (int32_t i = 0; i <= n_faces; ++i) offsets[i] = 4 * i;
    abut_faces faces = ABUT_FACES_INIT;
    faces.n_faces = n_faces, faces.nodes = corners, faces.n_nodes = 4 * n_faces, faces.offsets = offsets;
    faces.body = body, faces.depth = depth, faces.stiffness = stiffness, faces.n_bodies = 2;
    faces.shear_stiffness = shear_stiffness;

    const size_t n = 3 * (size_t)n_nodes;
    abut_array x_0 = {read_array(in, sizeof(double), n), n_nodes, 3, 1};
    abut_array force = {malloc(sizeof(double) * n), n_nodes, 3, 1};
    abut_contact* contact = NULL;
    abut_error error = ABUT_ERROR_INIT;
    check(abut_create(3, x_0, &faces, &options, &contact, &error), &error);
    for (int32_t step = 0; step < head[2]; ++step) {
        const abut_array x_1 = {read_array(in, sizeof(double), n), n_nodes, 3, 1};
        abut_step_result result = ABUT_STEP_RESULT_INIT;
        memset(force.data, 0, sizeof(double) * n);
        check(abut_step(contact, 0.01, x_0, x_1, step % 2 == 0 ? ABUT_MEAN : ABUT_END, force, &result, &error), &error);
        int64_t n_pairs = 0;
        check(abut_pairs(contact, NULL, sizeof(abut_pair), 0, &n_pairs, &error), &error);
        abut_pair* pairs = malloc(sizeof(abut_pair) * (size_t)n_pairs + 1);
        check(abut_pairs(contact, pairs, sizeof(abut_pair), n_pairs, &n_pairs, &error), &error);
        int64_t n_rubbing = 0;
        check(abut_friction(contact, NULL, sizeof(abut_face_friction), 0, &n_rubbing, &error), &error);
        abut_face_friction* rubbing = malloc(sizeof(abut_face_friction) * (size_t)n_rubbing + 1);
        check(abut_friction(contact, rubbing, sizeof(abut_face_friction), n_rubbing, &n_rubbing, &error), &error);
        const double figures[6] = {result.energy_0,        result.energy,     (double)n_pairs,
                                   result.friction_energy, result.dissipated, (double)n_rubbing};
        fwrite(force.data, sizeof(double), n, out);
        fwrite(figures, sizeof(double), 6, out);
        for (const abut_pair* p = pairs; p < pairs + n_pairs; ++p) {
            const double of_pair[14] = {p->face_1,   p->face_2,   p->normal[0],    p->normal[1],    p->normal[2],
                                        p->gap_0,    p->gap_1,    p->area,         p->normal_force, p->force[0],
                                        p->force[1], p->force[2], p->active_share, p->compression};
            fwrite(of_pair, sizeof(double), 14, out);
            fwrite(p->friction, sizeof(double), 3, out);
            fwrite(p->slip, sizeof(double), 3, out);
            fwrite(p->point, sizeof(double), 3, out);
        }
        for (const abut_face_friction* f = rubbing; f < rubbing + n_rubbing; ++f) {
            const double of_face[6] = {f->face, f->normal_force, f->force, f->limit, f->slip, f->dissipated};
            fwrite(of_face, sizeof(double), 6, out);
        }
        free(rubbing);
        free(pairs);
        free(x_0.data);
        x_0 = x_1;
    }
    abut_destroy(contact);
    free(x_0.data), free(force.data), free(offsets), free(depth), free(body), free(corners);
    fclose(in);
    return ferror(out) || fclose(out) ? 1 : 0;
}
