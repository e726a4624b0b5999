/* Contact between deformable solids whose surfaces are made of nodes, for C99 and for all that calls C.

   A host makes an `abut_contact` of its boundary faces once, calls `abut_step` once per step with the positions of its nodes at
   both ends, and adds the forces. docs/embedding.md and docs/languages.md walk through it, docs/method.md has the equations.

   Rules that hold for all functions:
   - They return a status, ABUT_OK or what went wrong; then nothing has changed that the next steps depend on, and `error` (may be
     NULL) says where, how much, how much is allowed and what to do. After a refused step the tables of `abut_pairs` and so on
     hold what was refused, and counters may have seen it. No exception, no abort and no exit crosses this border.
   - Structs that may grow begin with `struct_size`: set it to sizeof the struct. The ABUT_..._INIT macros do.
   - Arrays are the caller's, are read while the call lasts, and are not kept. NULL is refused by name where data are needed.
   - Handles are independent of each other: two threads may use two of them at once. A call for one that is in use, by another
     thread or from one of its callbacks, gets ABUT_MISUSE; `abut_destroy` must not meet one.
   Lengths are in m, forces in N, energies in J, or in any consistent set of units. */
#ifndef ABUT_H
#define ABUT_H
#include <stddef.h>
#include <stdint.h>

#if defined(ABUT_C_STATIC)
#define ABUT_API
#else
#define ABUT_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

enum {
    ABUT_OK = 0,
    ABUT_BAD_INPUT = 1,      /* a surface, an option or an array that cannot be used: correct it */
    ABUT_MISUSE = 2,         /* a call out of order, or without a handle: correct the program */
    ABUT_DIVERGED = 3,       /* a position is not finite, or moves too far in a step: take a smaller step */
    ABUT_TOO_DEEP = 4,       /* faces are pressed in deeper than allowed: smaller step, finer mesh, or a higher limit */
    ABUT_LIMIT_EXCEEDED = 5, /* a search would take more pairs or memory than allowed */
    ABUT_CANCELLED = 6,      /* `cancel` asked for it */
    ABUT_CALLBACK = 7,       /* an exception came out of a callback */
    ABUT_OUT_OF_MEMORY = 8,
    ABUT_INTERNAL = 9        /* a fault of Abut: please report it */
};

/* What went wrong. face_1 and face_2 count from the caller's `index_base`, the message from 0; what does not apply is -1 or NaN. */
typedef struct abut_error {
    size_t struct_size;
    int32_t status;
    int64_t face_1;
    int64_t face_2;
    double value;   /* found */
    double allowed; /* the limit */
    char message[1024];
} abut_error;
#define ABUT_ERROR_INIT {sizeof(abut_error), 0, -1, -1, 0.0, 0.0, {0}}

/* One vector per node in an array of the host's own: component d of node i is data[i * item + d * component]. u[n][3] has item 3 and
   component 1, as has Fortran's u(3, n); one array per component has item 1. Strides count doubles and may be negative. */
typedef struct abut_array {
    double* data;
    int64_t count; /* nodes */
    int64_t item;
    int64_t component;
} abut_array;

/* The boundary faces of all bodies. */
typedef struct abut_faces {
    size_t struct_size;
    int64_t n_faces;
    /* Corners, one face after the other: two, with the outside on the right of the line from the first to the second (2D); three or
       four, counter-clockwise seen from outside (3D). */
    const int32_t* nodes;
    int64_t n_nodes;         /* entries of `nodes` */
    const int32_t* offsets;  /* (n_faces + 1) where each face begins in `nodes`; NULL: all have as many corners as dimensions */
    const int32_t* body;     /* (n_faces); those of one body touch if self_contact is on */
    const double* depth;     /* (n_faces) half the height of the element behind a face; 0 for a rigid one */
    const double* stiffness; /* (n_bodies) from `abut_skin_stiffness`; infinity: a rigid body */
    /* (n_bodies) needed with friction, else NULL: mu/(lambda + 2 mu) of `stiffness`, which is `abut_skin_stiffness` of the shear
       modulus mu with the same depths */
    const double* shear_stiffness;
    int64_t n_bodies;
    int32_t index_base; /* 0 or 1: from where nodes, offsets, bodies and faces are counted, here and in all results */
} abut_faces;
#define ABUT_FACES_INIT {sizeof(abut_faces), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}

/* Cells of a host, for abut_surface_of. */
typedef struct abut_cells {
    size_t struct_size;
    int64_t n_cells;
    /* Corners, one cell after the other, in the order that VTK and most codes have: three or four (2D); four (tetrahedron), five
       (pyramid), six (prism) or eight (hexahedron) */
    const int32_t* nodes;
    int64_t n_nodes;         /* entries of `nodes` */
    const int32_t* offsets;  /* (n_cells + 1) where each cell begins in `nodes`; NULL: all have as many corners */
    const int32_t* body;     /* (n_cells); NULL: all are of one body */
    int32_t index_base;      /* 0 or 1, also of what comes out */
} abut_cells;
#define ABUT_CELLS_INIT {sizeof(abut_cells), 0, 0, 0, 0, 0, 0}

/* Boundary faces that Abut has found. */
typedef struct abut_surface abut_surface;

enum { ABUT_NOTE = 0, ABUT_WARNING = 1 };

/* A law of friction, in the words of abut_options. */
typedef struct abut_friction_law {
    double friction;
    double sliding_friction;
    double decay_speed;
    double decay_slip;
    double shear_strength;
    double relaxation_time;
} abut_friction_law;

/* All choices; `abut_options_init` fills in the defaults. */
typedef struct abut_options {
    size_t struct_size;
    double skin;                /* how far two faces may move together before the list is rebuilt; 0: chosen as the run goes */
    double largest_motion;      /* a face that moves farther in a step than this times the extent of all has diverged */
    int64_t max_pairs;          /* of a search */
    double compression_warning; /* |g|/D above which a step counts as strongly compressed */
    double compression_limit;   /* |g|/D above which a step is refused */
    double facing_full;         /* n_1 . n_2 up to which a pair acts with all its stiffness, */
    double facing_none;         /* and from which on not at all */
    double friction;            /* coefficient between faces that touch; 0: none. docs/friction.md */
    double sliding_friction;    /* that of fast sliding; NaN: the same */
    double decay_speed;         /* of sliding, at which it has gone 1 - 1/e of the way there [m/s] */
    double decay_slip;          /* path of sliding after which it is there [m] */
    double shear_strength;      /* stress that faces in contact bear beside it, whatever presses them [Pa] (Tresca) */
    double relaxation_time;     /* in which a force that sticks falls by 1/e [s]: damps rigid bodies that flutter */
    int32_t events;             /* not 0: look closer at a step where the mean of its ends is not enough */
    int32_t gauss;              /* not 0: integrate the forces of all pairs over a step by Gauss's rule */
    int32_t self_contact;       /* not 0: also faces of one body touch each other */
    /* Whether two faces may touch; NULL: all. Asked at searches, by the thread that calls. */
    int (*wanted)(int32_t face_1, int32_t face_2, void* user);
    /* Which law of friction two faces have, in either order: 0 that above, i from 1 on the i-th of `laws`, below 0 none; NULL:
       all have that above. Asked at searches; it must always tell the same. `laws` are read by `abut_create` alone. */
    int32_t (*law_of)(int32_t face_1, int32_t face_2, void* user);
    const abut_friction_law* laws;
    int64_t n_laws;
    /* In place of `friction` and the three after it: the coefficient of faces that slide with `speed` [m/s], have `slid` so far [m] and
       are under `pressure` [Pa]; finite, >= 0, and of these alone. NULL: those are taken. Asked in steps. */
    double (*own_coefficient)(double speed, double slid, double pressure, void* user);
    /* Time over which faces that overlap at the start on purpose (press fits) come to push each other [s], from the first step on; 0:
       none do. docs/method.md, Interference. */
    double interference_time;
    /* Which two faces may overlap so; NULL: all. Asked at searches; it must always tell the same. */
    int (*interferes)(int32_t face_1, int32_t face_2, void* user);
    /* Asked at the begin of each step; not 0: the step is cancelled. NULL: never. */
    int (*cancel)(void* user);
    /* Told what a user of the host ought to know and that is no error; NULL: nobody. */
    void (*log)(int severity, const char* text, void* user);
    void* user; /* handed to all of them */
} abut_options;
ABUT_API void abut_options_init(abut_options* options);

typedef struct abut_contact abut_contact;

enum {
    ABUT_MEAN = 0, /* the exact mean of the force along the step: MEMM */
    ABUT_END = 1   /* the force at its end: central differences */
};

/* What contact did in a step. */
typedef struct abut_step_result {
    size_t struct_size;
    double energy_0; /* W at the start */
    double energy;   /* W at the end */
    double work;     /* of rigid bodies on their paths on the rest */
    int64_t active_pairs;
    int64_t events;
    double compression; /* largest |g|/D */
    double correction;  /* what closes the balance of energy, over all forces: beyond 1e-3 the step is too long */
    /* Of friction: V of a host is its own + energy + friction_energy, and H~ + the sum of dissipated - work stays. */
    double friction_energy; /* E at the end, held by faces that stick; `abut_evaluate` leaves it as it is */
    double dissipated;      /* D in this step */
    int64_t sticking_faces;
    int64_t sliding_faces;
    double interference_work; /* by how much W grows with the interference in this step, from outside: H~ less the sum of it stays */
} abut_step_result;
#define ABUT_STEP_RESULT_INIT {sizeof(abut_step_result), 0.0, 0.0, 0.0, 0, 0, 0.0, 0.0, 0.0, 0.0, 0, 0, 0.0}

/* Vectors have three components everywhere, the last one 0 in 2D; moments of 2D are in the last one. */
typedef struct abut_pair {
    int32_t face_1;
    int32_t face_2;
    double normal[3]; /* unit, from face 1 into face 2 */
    double gap_0;     /* the least over the overlap at the start, 0 where it is not pressed in */
    double gap_1;     /* the same at the end */
    double area;      /* mean over the step */
    double normal_force;
    double force[3]; /* on face 2, mean over the step, friction included; face 1 feels the opposite */
    int32_t events;
    double active_share; /* of the step */
    double compression;  /* |g|/D */
    double friction[3];  /* the part of `force` that is friction */
    double slip[3];      /* motion of face 2 past face 1 along both, where there is friction */
    double point[3];     /* where friction acts, at the middle of the step */
} abut_pair;

/* Friction of a face in a step; a face with four corners appears by halves. After an evaluation: the faces with
   friction in the last step and their slip, all else 0. */
typedef struct abut_face_friction {
    int32_t face;
    double normal_force; /* that its friction is of: half of that on the face, all of it where the partner is rigid */
    double force;        /* along the face, mean over the step */
    double limit;        /* at which it slides */
    double slip;         /* in the last step; 0: it stuck */
    double dissipated;   /* in this step; below 0 by rounding alone with ABUT_MEAN */
} abut_face_friction;

typedef struct abut_body {
    int32_t body;
    double force[3];
    double moment[3]; /* about the origin, at the middle of the step */
    double work;      /* what it does by its own motion on what it touches */
} abut_body;

typedef struct abut_body_pair {
    int32_t body_1;
    int32_t body_2;
    int64_t active_pairs;
    double force[3]; /* on body 2 */
    double normal_force;
} abut_body_pair;

/* Counters since the start. */
typedef struct abut_report {
    size_t struct_size;
    int64_t candidates;
    int64_t candidates_max;
    int64_t active_pairs;
    int64_t active_pairs_max;
    int64_t events;
    int64_t rebuilds;
    int64_t missed_contacts; /* must stay 0 */
    int64_t inadmissible_overlaps;
    int64_t compressed_steps;
    int64_t tilted_pairs_max;
    double compression_max;
    double correction_max;
    double friction_dissipated; /* D so far */
    double least_dissipated;    /* of one face in one step */
    double friction_ratio_max;  /* largest force of a face over its limit */
    double sliding_force;       /* sum over faces that slide and all steps, times dt */
    double sliding_limit;       /* the same of their limits; far above it: their slip alternates from step to step */
    int64_t sticking_faces;     /* in the last step */
    int64_t sliding_faces;
    int64_t sticking_faces_max; /* the most in a step */
    int64_t sliding_faces_max;
} abut_report;
#define ABUT_REPORT_INIT \
    {sizeof(abut_report), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0, 0, 0, 0}

typedef struct abut_stable {
    size_t struct_size;
    double dt; /* 0.85 * 2/omega, by estimate */
    double omega;
    double omega_free;
    int64_t node; /* whose contact raises omega most; -1: nothing can touch */
    char reason[256];
} abut_stable;
#define ABUT_STABLE_INIT {sizeof(abut_stable), 0.0, 0.0, 0.0, -1, {0}}

typedef struct abut_overlap {
    int32_t face_1;
    int32_t face_2;
    double area;
    double normal[3]; /* unit, from face 1 into face 2 */
    double gap;       /* between the centroids, > 0 apart */
    double distance;  /* of the faces in space, 0 where they touch or cross; right to 1e-6 of their size */
} abut_overlap;

/* "0.1.0" */
ABUT_API const char* abut_version(void);
/* Threads that all handles together use from now on; 0: as many as there are cores. */
ABUT_API int abut_limit_threads(int32_t n, abut_error* error);

/* One k per body: lambda + 2 mu over the mean depth of those of its faces that will touch; with mu its shear stiffness. */
ABUT_API int abut_skin_stiffness(double modulus, const double* depth, int64_t n, double* stiffness, abut_error* error);

/* The faces that one cell alone has, turned outwards whatever the sense of the cells, with half the height of the cell behind each as
   depth. */
ABUT_API int abut_surface_of(int32_t dim, abut_array rest, const abut_cells* cells, abut_surface** surface, abut_error* error);
/* Points `faces` (nodes, offsets, body, depth and their numbers; the rest of it stays) and `cell` (n_faces, the cell behind each; may
   be NULL) at what the surface holds until `abut_surface_destroy`. */
ABUT_API int abut_surface_faces(const abut_surface* surface, abut_faces* faces, const int32_t** cell, abut_error* error);
/* NULL is no error. */
ABUT_API void abut_surface_destroy(abut_surface* surface);

/* `rest`: all nodes of the host at rest. Obstacles are rigid bodies, whose nodes the host places. `options` may be NULL. */
ABUT_API int abut_create(int32_t dim, abut_array rest, const abut_faces* faces, const abut_options* options,
                         abut_contact** contact, abut_error* error);
/* NULL is no error. */
ABUT_API void abut_destroy(abut_contact* contact);

/* From x_0 to x_1 in a step that takes dt [s], finite and > 0; without friction nothing depends on it. Adds the forces to `force`
   (data NULL: does not), which may end before the nodes of obstacles do, but not before those of other faces. `result` may be NULL. */
ABUT_API int abut_step(abut_contact* contact, double dt, abut_array x_0, abut_array x_1, int32_t take, abut_array force,
                       abut_step_result* result, abut_error* error);
/* W and forces at any x, those of friction by the springs of faces that stick as they are, without a step: changes nothing that
   the next steps depend on. */
ABUT_API int abut_evaluate(abut_contact* contact, abut_array x, abut_array force, double* energy, abut_error* error);

/* Of the last of these two. They write the number of entries to `n`, and at most `capacity` of them; NULL and 0 ask for the number
   alone. `entry_size` is sizeof an entry. */
ABUT_API int abut_pairs(const abut_contact* contact, abut_pair* pairs, size_t entry_size, int64_t capacity, int64_t* n,
                        abut_error* error);
ABUT_API int abut_bodies(const abut_contact* contact, abut_body* bodies, size_t entry_size, int64_t capacity, int64_t* n,
                         abut_error* error);
ABUT_API int abut_body_pairs(const abut_contact* contact, abut_body_pair* pairs, size_t entry_size, int64_t capacity, int64_t* n,
                             abut_error* error);
/* Of the last step; empty after `abut_evaluate`. */
ABUT_API int abut_friction(const abut_contact* contact, abut_face_friction* faces, size_t entry_size, int64_t capacity,
                           int64_t* n, abut_error* error);
ABUT_API int abut_get_report(const abut_contact* contact, abut_report* report, abut_error* error);

/* `mass`: of each node; `omega_free`: the highest frequency of the host without contact [rad/s]. */
ABUT_API int abut_stable_step(const abut_contact* contact, const double* mass, int64_t n, double omega_free, abut_stable* stable,
                              abut_error* error);

/* All that the next steps depend on, as bytes: after `abut_restore` into a contact of the same surface and options they are bitwise
   identical. `n` gets the size, also where `capacity` is too small; then nothing is written. */
ABUT_API int abut_save(const abut_contact* contact, void* bytes, int64_t capacity, int64_t* n, abut_error* error);
ABUT_API int abut_restore(abut_contact* contact, const void* bytes, int64_t n, abut_error* error);

/* Goes on with other faces, between two steps, as after an erosion. `old_face_of` (n_faces): the old number of each face that was
   there before; below `index_base`: a face that was not, for whose pairs the run begins: what is pressed in is a contact. The index
   base stays that of the first faces. */
ABUT_API int abut_replace_surface(abut_contact* contact, abut_array rest, const abut_faces* faces, const int32_t* old_face_of,
                                  abut_error* error);

/* Every pair of faces of two bodies that look at each other, share an area, and have a gap of at most `distance`, apart or
   pressed in, at x; each call searches from the beginning. Depths and stiffnesses are not looked at and may be NULL.
   Faces with four corners appear by halves. */
ABUT_API int abut_find_overlaps(int32_t dim, abut_array x, const abut_faces* faces, double distance, abut_overlap* overlaps,
                                size_t entry_size, int64_t capacity, int64_t* n, abut_error* error);

#ifdef __cplusplus
}
#endif
#endif
