/* step_cost <scene> <calls>: microseconds of processor time per abut_step, active pairs and W. The scene is one of
   compare.py; its last step is repeated. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

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
    FILE* scene = argc == 3 ? fopen(argv[1], "rb") : NULL;
    if (scene == NULL) return perror("step_cost <scene> <calls>"), 2;
    const long calls = atol(argv[2]);
    const int32_t* head = read_array(scene, sizeof(int32_t), 2);
    const size_t n_nodes = (size_t)head[0], n_faces = (size_t)head[1];
    abut_faces faces = ABUT_FACES_INIT;
    faces.n_faces = head[1], faces.n_nodes = 3 * faces.n_faces, faces.n_bodies = 2;
    faces.nodes = read_array(scene, sizeof(int32_t), 3 * n_faces);
    faces.body = read_array(scene, sizeof(int32_t), n_faces);
    faces.depth = read_array(scene, sizeof(double), n_faces);
    faces.stiffness = read_array(scene, sizeof(double), 2);
    abut_array x[3];
    for (int i = 0; i < 3; ++i) x[i] = (abut_array){read_array(scene, sizeof(double), 3 * n_nodes), head[0], 3, 1};
    const abut_array force = {calloc(3 * n_nodes, sizeof(double)), head[0], 3, 1};

    abut_contact* contact = NULL;
    abut_error error = ABUT_ERROR_INIT;
    abut_step_result result = ABUT_STEP_RESULT_INIT;
    check(abut_create(3, x[0], &faces, NULL, &contact, &error), &error);
    check(abut_step(contact, 1.0, x[0], x[1], ABUT_MEAN, force, &result, &error), &error);
    const clock_t start = clock();
    for (long i = 0; i < calls; ++i) check(abut_step(contact, 1.0, x[1], x[2], ABUT_MEAN, force, &result, &error), &error);
    const double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    printf("%.4f %" PRId64 " %.16e\n", 1e6 * seconds / (double)calls, result.active_pairs, result.energy);
    abut_destroy(contact);
    return 0;
}
