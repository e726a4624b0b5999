/* Solids in contact that another program drives, for C99. Bodies may be elastic, rubber, wood or metal that yields. The program sets
   tractions on boundary faces, dictates the step, and is told where these faces move. docs/loads.md has the equations; the rules of abut.h hold here, too: statuses, errors, arrays of the
   caller's own, one thread at a time.

   First bodies, supports and loads are added; `abut_solid_begin` makes the solid, and after it nothing can be added. Then each step:

       abut_solid_set_step(solid, dt, ABUT_KEEP, &error);
       abut_solid_faces(solid, "bar.xmin", &faces, &error);         faces.motion: how far they will move in the step
       ... the fluid takes its step on walls that move so far, and gives its mean tractions ...
       abut_solid_set_traction(solid, "bar.xmin", traction, &error);
       abut_solid_step(solid, &error);

   SI units, or any consistent set; in 2D plane strain, and forces and energies per metre of thickness. Faces of a group come in
   one order throughout. */
#ifndef ABUT_SOLID_H
#define ABUT_SOLID_H
#include "abut.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct abut_solid abut_solid;

/* Isotropic linear elasticity: what a body begins with. Other laws and numbers: abut_solid_set_text and _set_number. */
typedef struct abut_material {
    double young;
    double poisson;
    double density;
} abut_material;

/* dim: 2 or 3. */
ABUT_API int abut_solid_create(int32_t dim, abut_solid** solid, abut_error* error);
/* NULL is no error. */
ABUT_API void abut_solid_destroy(abut_solid* solid);

/* A body of `counts` rectangular cells along each axis, with groups of faces "xmin", "xmax", ... `velocity` at the start may be
   NULL: 0. All vectors have dim numbers. Groups, and then bodies, of several meshes that have one name in common get
   "<body>." in front: "bar.xmin". */
ABUT_API int abut_solid_add_box(abut_solid* solid, const char* name, const double* lower, const double* upper,
                                const int32_t* counts, abut_material material, const double* velocity, abut_error* error);
/* The bodies of a mesh file, .msh or .vtu, with its groups; all of one material and velocity. */
ABUT_API int abut_solid_add_file(abut_solid* solid, const char* path, abut_material material, const double* velocity,
                                 abut_error* error);
/* A group does not move at all, or not along its normals; what touches it meets it as rigid. */
ABUT_API int abut_solid_clamp(abut_solid* solid, const char* group, abut_error* error);
ABUT_API int abut_solid_roller(abut_solid* solid, const char* group, abut_error* error);
/* A group is loaded from outside; `traction` acts until the first is set, NULL: 0. */
ABUT_API int abut_solid_load(abut_solid* solid, const char* group, const double* traction, abut_error* error);

/* Two sides, each a body or a group by its name, are glued where they lie on each other, whether their meshes match or not: until a
   traction reaches `strength` [Pa], pressure not counted (with `fracture_energy` 0: pulls them apart with it), INFINITY: for ever. `fracture_energy` [J/m^2]: what a place takes as it opens, 0: it breaks
   at once. Glued faces do not touch the body that they are glued to. docs/method.md, Bonds. */
ABUT_API int abut_solid_bond(abut_solid* solid, const char* side_1, const char* side_2, double strength,
                             double fracture_energy, abut_error* error);

/* A body that may break is cut into grains when this is called: bodies "<body>.1", "<body>.2", ..., which are bonded with each other
   where they have faces in common (docs/method.md, Break-up). "<body>" still names all of them together, in the functions below, and its
   groups of faces stay: a bond to it names one of these, or a piece. It is the only body of its box or file, its kinematics are
   "floating" or "finite", and contact acts. */
typedef struct abut_fracture {
    size_t struct_size;
    double grain;           /* size of the pieces: edge of a square or cube as large [m]. Cracks follow their faces */
    double strength;        /* largest traction that a face between pieces bears, pressure not counted [Pa] */
    double fracture_energy; /* that an opening crack takes per area [J/m^2]; 0: faces break at once */
    double weibull;         /* modulus of the scatter of strength from face to face; 0: none */
    int32_t seed;           /* another one gives other pieces and another scatter */
} abut_fracture;
#define ABUT_FRACTURE_INIT {sizeof(abut_fracture), 0.0, 0.0, 0.0, 0.0, 0}
ABUT_API int abut_solid_set_fracture(abut_solid* solid, const char* body, const abut_fracture* fracture, abut_error* error);

/* What a body is made of and how it moves, by the names that scenes have (docs/scenes.md, [bodies.NAME]); of several calls the last counts.
   A name or a value that cannot be is refused at once, a body that is not there by `abut_solid_begin`: destroy the solid then.
   - Numbers of a material, SI: "yield_stress", "hardening", "kinematic_hardening", "thermal_expansion", "mass_damping", ...
   - Texts: "law" is "st_venant_kirchhoff", "j2" (metal that yields), "orthotropic", of finite bodies "neo_hookean", "mooney_rivlin";
     "kinematics" is "small", which bodies are where nothing is said, "floating", "finite" or "rigid"; "material" is one
     that is known by its name, "steel S235" (docs/scenes.md, Materials by name), in the place of the values that the body was added
     with, and with "law" "j2" of its flow as well; and all numbers with units, "young" "210 GPa".
   - Lists: "axis_1" and "axis_2" (3) of orthotropic in 3D; "hardening_table", rows of plastic strain and stress. */
ABUT_API int abut_solid_set_number(abut_solid* solid, const char* body, const char* key, double value, abut_error* error);
ABUT_API int abut_solid_set_text(abut_solid* solid, const char* body, const char* key, const char* text, abut_error* error);
ABUT_API int abut_solid_set_numbers(abut_solid* solid, const char* body, const char* key, const double* numbers, int64_t n,
                                    abut_error* error);
/* Temperature of a body above its stress-free one [K], as a function of time and of the position at rest. The body deforms,
   and its material has a "thermal_expansion". `rise` is called by the thread that calls `abut_solid_begin` and `_step`, and by
   `abut_solid_faces` for `motion`: once, with time 0, or if `varies` is not 0 with the time at which each step starts. `rise` and `user`
   must stay valid until `abut_solid_destroy`. */
ABUT_API int abut_solid_set_temperature(abut_solid* solid, const char* body,
                                        double (*rise)(double time, const double* position, void* user), int32_t varies,
                                        void* user, abut_error* error);

typedef struct abut_solid_options {
    size_t struct_size;
    double dt;      /* at most the stable step; 0: cfl times it */
    double cfl;     /* of the stable step, at most 1; 0: 0.9 */
    int32_t contact; /* 0: bodies pass through each other */
    int32_t restart; /* steps from one neutral restart to the next; 0: with friction 10, else with finite bodies 50,
                        else none. Where tractions answer to the motion of a step: 20 */
    double friction; /* coefficient between all bodies; the neutral filter acts with it. 0: none */
    void (*log)(int severity, const char* text, void* user); /* told of each ABUT_WARNING; may be NULL */
    void* user;                                              /* yours, for `log` */
} abut_solid_options;
#define ABUT_SOLID_OPTIONS_INIT {sizeof(abut_solid_options), 0.0, 0.9, 1, 0, 0.0, NULL, NULL}
/* Makes the solid and its integrator, MEMM; after an error the same can be tried again. `options` may be NULL. */
ABUT_API int abut_solid_begin(abut_solid* solid, const abut_solid_options* options, abut_error* error);

ABUT_API int abut_solid_n_faces(const abut_solid* solid, const char* group, int64_t* n, abut_error* error);

/* Where the faces of a group that is loaded are. Arrays with data NULL are not written; the others have n_faces entries. */
typedef struct abut_solid_face_arrays {
    size_t struct_size;
    int64_t n_faces;
    abut_array position; /* of the centroids */
    abut_array velocity; /* of the same */
    abut_array normal;   /* out of the body, unit length, at rest */
    abut_array motion;   /* how far the centroids move in the next step of the present dt, whatever acts in it */
    double* area;        /* at rest: times a traction it is a force; may be NULL */
    double* bonded;      /* the part of `area` that bonds hold to another body; may be NULL */
} abut_solid_face_arrays;
#define ABUT_SOLID_FACE_ARRAYS_INIT \
    {sizeof(abut_solid_face_arrays), 0, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, 0, 0}
ABUT_API int abut_solid_faces(abut_solid* solid, const char* group, const abut_solid_face_arrays* faces, abut_error* error);

/* Forces per area, one per face, from the next step on until they are set again. */
ABUT_API int abut_solid_set_traction(abut_solid* solid, const char* group, abut_array traction, abut_error* error);

/* The cells of a body, in one order throughout. Arrays with data NULL are not written; the others have n_cells entries. */
typedef struct abut_solid_cell_arrays {
    size_t struct_size;
    int64_t n_cells;
    abut_array position;    /* of the centroids */
    abut_array velocity;    /* of the same */
    abut_array stress;      /* Cauchy's, dim x dim numbers each: xx, xy, ... */
    double* plastic_strain; /* equivalent; may be NULL */
    int32_t* fragment;      /* see abut_solid_fragments, from 0 on; -1 of a body without bonds. May be NULL */
} abut_solid_cell_arrays;
#define ABUT_SOLID_CELL_ARRAYS_INIT {sizeof(abut_solid_cell_arrays), 0, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, 0, 0}
ABUT_API int abut_solid_n_cells(const abut_solid* solid, const char* body, int64_t* n, abut_error* error);
/* Costs about a force. */
ABUT_API int abut_solid_cells(abut_solid* solid, const char* body, const abut_solid_cell_arrays* cells, abut_error* error);

/* Pieces that bonds hold together as they are now, in the order of their first bodies; a body that never had a bond is none. Arrays with
   data NULL are not written; the others have n_fragments entries. */
typedef struct abut_solid_fragment_arrays {
    size_t struct_size;
    int64_t n_fragments;
    abut_array centre;   /* of mass */
    abut_array velocity; /* of the same */
    abut_array spin;     /* as of a rigid body with its angular momentum: 1 number in 2D, 3 in 3D */
    double* mass;        /* may be NULL */
    int64_t* n_cells;    /* may be NULL */
} abut_solid_fragment_arrays;
#define ABUT_SOLID_FRAGMENT_ARRAYS_INIT \
    {sizeof(abut_solid_fragment_arrays), 0, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, 0, 0}
ABUT_API int abut_solid_n_fragments(const abut_solid* solid, int64_t* n, abut_error* error);
ABUT_API int abut_solid_fragments(abut_solid* solid, const abut_solid_fragment_arrays* fragments, abut_error* error);

enum {
    ABUT_KEEP = 0,   /* momenta stay: for slow and smooth changes of dt; H~ is exact */
    ABUT_RESTART = 1 /* momenta are rebuilt: for abrupt ones; what that changes in H~ is in `restart_jumps` */
};
/* `dt`: at most abut_solid_state.stable_dt. The first change by more than 5 % is logged: dictate times then, see below. */
ABUT_API int abut_solid_set_step(abut_solid* solid, double dt, int32_t change, abut_error* error);
/* After ABUT_TOO_DEEP or ABUT_DIVERGED the run is over. */
ABUT_API int abut_solid_step(abut_solid* solid, abut_error* error);

/* Times that you dictate, while the solid keeps its own step (docs/loads.md, Times that are dictated):
       abut_solid_begin_clock(solid, ABUT_AS_GIVEN, &error);
       abut_solid_clock(solid, &time, &time_to_node, &error);      your step: d <= time_to_node, where its motion is known before
       abut_solid_motion(solid, "wet", d, motion, &error);
       abut_solid_set_traction(solid, "wet", traction, &error);
       abut_solid_advance(solid, d, &error);
   `abut_solid_set_traction` acts at once then, and `abut_solid_faces` has the faces as they are now. */
enum {
    ABUT_AS_GIVEN = 0, /* the mean of the tractions acts in each step of the solid: works are the same to round-off */
    ABUT_TRAPEZOID = 1 /* that of loads at both of its nodes: no restarts are needed where tractions answer to the motion */
};
ABUT_API int abut_solid_begin_clock(abut_solid* solid, int32_t impulse, abut_error* error);
ABUT_API int abut_solid_clock(abut_solid* solid, double* time, double* time_to_node, abut_error* error);
/* How far the centroids of a group move in the next `d`, whatever acts; `motion` has n_faces entries. */
ABUT_API int abut_solid_motion(abut_solid* solid, const char* group, double d, abut_array motion, abut_error* error);
/* By a time of any length > 0. */
ABUT_API int abut_solid_advance(abut_solid* solid, double d, abut_error* error);
/* Keeps the state in the solid, in place of that of the call before; and goes back to it, for a step that is rejected. What follows
   has the same bits. */
ABUT_API int abut_solid_keep(abut_solid* solid, abut_error* error);
ABUT_API int abut_solid_go_back(abut_solid* solid, abut_error* error);

/* H~ + work_held + dissipated = its start + work_steps + work_changes + work_heat + restart_jumps, to round-off; and also
   H~ + dissipated = its start + "work" (abut_solid_get_number) + restart_jumps, whatever acts. */
typedef struct abut_solid_state {
    size_t struct_size;
    int64_t steps;
    double time;
    double dt;
    double stable_dt;
    double pseudo_energy; /* H~, less the work of the loads that act */
    double energy;        /* H, the same */
    double kinetic;
    double work_steps;   /* of the tractions: area traction . motion, over all faces and steps, and where heat moves faces */
    double work_changes; /* what half-cells behind the faces take in where tractions change */
    double work_held;    /* what H~ has less for the tractions that act */
    double restart_jumps;
    double parasitic;        /* largest |e|/m: the alternating mode, as a velocity */
    int64_t active_pairs;    /* of contact, in the last step */
    int64_t missed_contacts; /* must stay 0 */
    double dissipated;       /* by friction, materials and bonds that open, so far */
    double friction_energy;  /* held by faces that stick, a part of H~ and H */
    int64_t sticking_faces;  /* in the last step */
    int64_t sliding_faces;
    double broken_bonds; /* the part of the area of all bonds that is broken; 0 without bonds */
    double work_heat;    /* of temperatures that vary, less what they make the tractions do */
    double beyond_fracture_energy; /* energy that bonds dissipated beyond their fracture energies; below 0: less */
} abut_solid_state;
#define ABUT_SOLID_STATE_INIT \
    {sizeof(abut_solid_state), 0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0, 0, 0.0, 0.0, 0, 0, 0.0, 0.0, 0.0}
/* Costs about two forces. */
ABUT_API int abut_solid_get_state(abut_solid* solid, abut_solid_state* state, abut_error* error);
/* A number of the ledger by the name of its column in energy.csv (docs/results.md): "work", "dissipated_in_cells", "linear_momentum_x",
   "rotation", ... The same cost. */
ABUT_API int abut_solid_get_number(abut_solid* solid, const char* column, double* value, abut_error* error);

#ifdef __cplusplus
}
#endif
#endif
