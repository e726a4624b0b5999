#pragma once
// Docstrings of the package for Python in the form of numpydoc: a summary line, then sections of parameters, results, errors
// and an example. tests/bindings/check_docstrings.py compares them with the signatures and runs the examples.

namespace abut::python::docs {

// Contact on nodes ----------------------------------------------------------------------------------------------------

inline constexpr const char* nodal_contact = R"(Contact of bodies whose surfaces are made of nodes, and whose faces may turn.

Arrays of float64 are read and written where they lie, whatever their strides. No callback may call anything of the
contact, and nothing that holds the contact is ever freed while they refer to it.

Parameters
----------
nodes : ndarray of float, (n_nodes, dim)
    Positions at rest [m].
faces : array of int, (n_faces, corners) or flat with `offsets`
    Nodes of each face, two, three or four of them.
body : array of int, (n_faces,)
    Body of each face, from 0.
depth : array of float, (n_faces,)
    Half the height of the element behind each face [m].
stiffness : array of float, (n_bodies,)
    `skin_stiffness` of each body [Pa/m]; inf for a rigid one.
offsets : array of int, (n_faces + 1,), optional
    Where each face begins in a flat `faces`.
shear_stiffness : array of float, (n_bodies,), optional
    As `stiffness`, with the shear modulus in place of lambda + 2 mu [Pa/m]. Friction needs it.
wanted : callable (face_1, face_2) -> bool, optional
    Whether two faces may touch.
cancel : callable () -> bool, optional
    Asked at the begin of each step; true cancels it.
log : callable (severity, text), optional
    Gets what ought to be known and is no error; without it `warnings.warn` tells.
law_of : callable (face_1, face_2) -> int, optional
    Law of friction of two faces: 0 that of the options, i the i-th of `laws`, below 0 none.
laws : list of dict, optional
    Laws of friction, with the names of these options.
own_coefficient : callable (speed, slid, pressure) -> float, optional
    Coefficient in place of `friction`, by speed [m/s], distance slid [m] and pressure [Pa].
interference_time : float, default 0
    Time over which faces that overlap at the start on purpose come to push each other [s]; 0: none do.
interferes : callable (face_1, face_2) -> bool, optional
    Whether two faces may overlap so; without it all may.
**kwargs
    Options of `abut_options` in C, with their defaults:
    )";

inline constexpr const char* nodal_contact_end = R"(

Raises
------
BadInput
    If the surface or an option cannot be used.
TypeError
    If there is no such option.

Examples
--------
>>> import abut, numpy as np
>>> points = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
>>> points = np.vstack([points, points + [0.0, 0.9]])  # the second square lies on the first one, 0.1 deep in it
>>> surface = abut.surface_of(points, [[0, 1, 2, 3], [4, 5, 6, 7]], body=[0, 1])
>>> contact = abut.NodalContact(points, **surface, stiffness=[1.0, 1.0], facing_none=-0.5)
>>> force = np.zeros_like(points)
>>> contact.evaluate(points, force) > 0.0
True
>>> bool(np.allclose(force.sum(axis=0), 0.0))
True
)";

inline constexpr const char* contact_step = R"(Takes a step and adds the forces of contact.

Parameters
----------
dt : float
    Length of the step [s], > 0. Without friction nothing depends on it.
x_0, x_1 : ndarray of float, (n_nodes, dim)
    Positions of the nodes at both ends of the step [m].
out : ndarray of float, (n, dim), optional
    Gets the forces added [N]. It may end before the nodes of obstacles do.
mode : {'mean', 'end'}
    Forces to take: the mean of the step, exact for energy, or that at its end, for central differences.

Returns
-------
dict
    energy_0 and energy, W at both ends [J]; work of rigid bodies [J]; active_pairs; events; compression; correction;
    of friction friction_energy, E at the end [J], dissipated, D in the step [J], sticking_faces and sliding_faces;
    interference_work, from outside [J].

Raises
------
Diverged
    If a position is not finite, or a node moves farther than `largest_motion`.
TooDeep
    If faces are pressed in deeper than `compression_limit`.
LimitExceeded
    If the search takes more than its limits allow.
Cancelled
    If `cancel` says so.
)";

inline constexpr const char* contact_evaluate = R"(Evaluates contact in one state, without a step.

Parameters
----------
x : ndarray of float, (n_nodes, dim)
    Positions of the nodes [m].
out : ndarray of float, (n, dim), optional
    Gets the forces in this state added [N].

Returns
-------
float
    Energy of contact W [J].

Raises
------
Diverged
    If a position is not finite.
)";

inline constexpr const char* contact_stable_step = R"(Estimates how long a step may be.

Parameters
----------
mass : array of float, (n_nodes,)
    Mass of each node [kg].
omega_free : float
    Highest frequency without contact [rad/s].

Returns
-------
dict
    dt [s]; omega, the highest frequency with contact, and omega_free [rad/s]; node, the one that decides, -1 if none
    does; reason, a text.

Raises
------
BadInput
    If a mass is not positive, or the number of masses is not that of the nodes.
)";

inline constexpr const char* contact_state = R"(Saves the state on which the next steps depend.

Returns
-------
bytes
    For `restore` of a contact of the same surface and options.
)";

inline constexpr const char* contact_restore = R"(Goes on from a saved state: the next steps are bitwise identical.

Parameters
----------
state : bytes
    Result of `state` of a contact of the same surface and options.

Returns
-------
None

Raises
------
BadInput
    If the state is none of such a contact.
)";

inline constexpr const char* contact_surface_replaced = R"(Goes on with other faces, between two steps.

Parameters
----------
nodes, faces, body, depth, stiffness
    The new surface, as in the constructor.
old_face_of : array of int, (n_faces,)
    Number of each face in the surface before; -1 if it was not there.
offsets, shear_stiffness
    As in the constructor.

Returns
-------
None

Raises
------
BadInput
    If the new surface cannot be used.
ValueError
    If `old_face_of` has not one entry per face.
)";

inline constexpr const char* find_overlaps = R"(Finds faces of two bodies that look at each other and share an area.

Parameters
----------
nodes : ndarray of float, (n_nodes, dim)
    Positions [m].
faces : array of int, (n_faces, corners) or flat with `offsets`
    Nodes of each face, as in `NodalContact`.
body : array of int, (n_faces,)
    Body of each face, from 0.
distance : float
    Largest gap of a pair that is listed [m].
offsets : array of int, (n_faces + 1,), optional
    Where each face begins in a flat `faces`.

Returns
-------
structured array
    One row per pair: face_1, face_2, area [m^(dim-1)], normal from the first into the second, gap [m] and distance in
    space [m]. A face with four corners appears by halves.

Raises
------
BadInput
    If the surface or the distance cannot be used.

Examples
--------
>>> import abut, numpy as np
>>> nodes = np.array([[0.0, 0.0], [1.0, 0.0], [0.25, 0.1], [1.25, 0.1]])
>>> pairs = abut.find_overlaps(nodes, [[1, 0], [2, 3]], body=[0, 1], distance=0.2)
>>> round(pairs["area"][0], 12), round(pairs["gap"][0], 12)
(0.75, 0.1)
)";

inline constexpr const char* surface_of = R"(Makes the boundary of cells, in the words of NodalContact.

Faces look outwards whatever the sense of the cells.

Parameters
----------
points : ndarray of float, (n_points, dim)
    Positions at rest [m].
cells : array of int, (n_cells, corners), or several
    Triangles, quadrangles, tetrahedra, pyramids, prisms or hexahedra. Several arrays come as {type: cells}, as pairs,
    or as the blocks of meshio.
body : array of int, (n_cells,), optional
    Body of each cell. Bodies have nodes of their own.
with_cells : bool, default False
    Whether to add `cell`.

Returns
-------
dict
    faces (flat), offsets, body, and depth, half the height of the cell behind each face [m]; with `with_cells` also
    cell, the one behind each face.

Raises
------
BadInput
    If the cells are none of a mesh.
ValueError
    If an array has another shape.

Examples
--------
>>> import abut, numpy as np
>>> points = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])
>>> surface = abut.surface_of(points, [[0, 1, 2], [0, 3, 2]])
>>> surface['faces'].reshape(-1, 2).tolist(), surface['depth'].tolist()
([[0, 1], [1, 2], [3, 0], [2, 3]], [0.5, 0.5, 0.5, 0.5])
>>> k = abut.skin_stiffness(1.0, surface['depth'])
>>> contact = abut.NodalContact(points, **surface, stiffness=[k])
)";

inline constexpr const char* skin_stiffness = R"(Computes the contact stiffness of a body.

Parameters
----------
modulus : float
    lambda + 2 mu [Pa]; with mu the result is the shear stiffness.
depth : array of float
    Depths of those faces of the body that will touch [m].

Returns
-------
float
    The modulus over the mean depth [Pa/m].

Raises
------
BadInput
    If a value is not positive.

Examples
--------
>>> import abut
>>> abut.skin_stiffness(6.0, [1.0, 2.0])
4.0
)";

inline constexpr const char* limit_threads = R"(Limits the threads that all contacts use together.

Parameters
----------
n : int
    Number of threads; 0: all cores.

Returns
-------
None

Raises
------
BadInput
    If the number is negative.
)";

// Meshes --------------------------------------------------------------------------------------------------------------

inline constexpr const char* mesh_class = R"(Bodies that share no point, cell or face.

It is made by the functions of this module, such as `mesh`, `read_mesh` and `box`. Its cells get new numbers;
`label` has their numbers before.
)";

inline constexpr const char* at_points = R"(Means values of cells at the points.

Parameters
----------
values : array of float, (n_cells, ...)
    Values of the cells.

Returns
-------
ndarray of float, (n_points, ...)
    Mean over the cells around each point.

Raises
------
ValueError
    If there is not one row per cell.
)";

inline constexpr const char* write_vtu = R"(Writes the mesh alone, with the cell array "body".

Parameters
----------
path : path
    File to write, in the format VTU.

Returns
-------
None

Raises
------
BadInput
    If the file cannot be written.
)";

inline constexpr const char* combine = R"(Makes one mesh of the bodies of several. Nothing is merged.

Parameters
----------
meshes : list of Mesh2D or of Mesh3D
    One or more.

Returns
-------
Mesh2D or Mesh3D
    All bodies, in the order of the list.

Raises
------
ValueError
    If there is no mesh.
BadInput
    If two bodies have one name.
)";

inline constexpr const char* box = R"(Makes a box of triangles or tetrahedra.

Parameters
----------
lower, upper : sequence of float, (dim,)
    Two opposite corners [m].
size : float, default 0.1
    Edge length of the cells [m].
variant : int, default 0
    Another number gives another mesh.
name : str, default 'box'
    Name of the body.

Returns
-------
Mesh2D or Mesh3D
    With the groups "xmin", "xmax", ...

Raises
------
BadInput
    If there is no such box.
)";

inline constexpr const char* structured_box = R"(Makes a box of equal bricks, each cut into cells of one shape.

Parameters
----------
lower, upper : sequence of float, (dim,)
    Two opposite corners [m].
counts : sequence of int, (dim,)
    Bricks along each axis.
shape : str
    'quad' or 'triangle'; in space 'hexahedron', 'tetra', 'wedge' or 'pyramid'.
name : str, default 'box'
    Name of the body.

Returns
-------
Mesh2D or Mesh3D
    With the groups "xmin", "xmax", ...

Raises
------
BadInput
    If there is no such box.
ValueError
    If there is no such shape.

Examples
--------
>>> from abut import solid
>>> block = solid.structured_box((0, 0), (2, 1), (4, 2))
>>> len(block.body), block.measures.sum()
(8, 2.0)
)";

inline constexpr const char* disc = R"(Makes a disc of triangles.

Parameters
----------
centre : sequence of float, (2,)
    Centre [m].
radius : float, default 1
    Radius [m].
size : float, default 0.1
    Edge length of the cells [m].
variant : int, default 0
    Another number gives another mesh. Equal parts in contact need different ones, or their meshes match.
name : str, default 'disc'
    Name of the body.

Returns
-------
Mesh2D
    With the group "boundary".

Raises
------
BadInput
    If there is no such disc.
)";

inline constexpr const char* cylinder = R"(Makes a cylinder of tetrahedra, with its axis along z.

Parameters
----------
centre : sequence of float, (3,)
    Centre [m].
radius, length : float, default 1
    Radius and length [m].
size : float, default 0.1
    Edge length of the cells [m].
variant : int, default 0
    Another number gives another mesh.
name : str, default 'cylinder'
    Name of the body.

Returns
-------
Mesh3D
    With the groups "side", "bottom" (low z) and "top".

Raises
------
BadInput
    If there is no such cylinder.
)";

inline constexpr const char* sphere = R"(Makes a sphere of tetrahedra.

Parameters
----------
centre : sequence of float, (3,)
    Centre [m].
radius : float, default 1
    Radius [m].
size : float, default 0.1
    Edge length of the cells [m].
variant : int, default 0
    Another number gives another mesh.
name : str, default 'sphere'
    Name of the body.

Returns
-------
Mesh3D
    With the group "boundary".

Raises
------
BadInput
    If there is no such sphere.
)";

inline constexpr const char* read_mesh = R"(Reads a .msh or .vtu file.

Parameters
----------
path : path
    File to read.
dim : {2, 3}
    Dimension of the mesh.
non_planar : {'fail', 'split'}
    What to do with faces that have a corner off their plane: an error, or cells are cut into tetrahedra.
planarity_tolerance : float
    How far a corner may be off, over the size of the face.

Returns
-------
Mesh2D or Mesh3D
    With the groups of the file.

Raises
------
BadInput
    If the file is no such mesh.
ValueError
    If `dim` is neither 2 nor 3.
)";

// Materials -----------------------------------------------------------------------------------------------------------

inline constexpr const char* material = R"(Elasticity, and plasticity where the law has it; plane strain in 2D.

Parameters
----------
material : str, optional
    A name in `known_materials`, whose values stand where none is given.
**kwargs
    Values by name, as numbers or as texts with units.

Raises
------
BadInput
    If a value has a unit of another dimension.
TypeError
    If there is no such value.
ValueError
    If no material has that name.

Examples
--------
>>> from abut import solid
>>> solid.Material(young="210 GPa", poisson=0.3, density=7850).young
210000000000.0
>>> solid.Material("steel S235", law="j2").yield_stress
235000000.0
)";

inline constexpr const char* known_materials = R"(Lists the materials that scenes and Material know by their names.

Returns
-------
dict of dict
    By name: young [Pa], poisson, density [kg/m^3], yield_stress [Pa], 0 where there is none, and source.

Examples
--------
>>> from abut import solid
>>> solid.known_materials()["steel S235"]["poisson"]
0.3
)";

// Runs ----------------------------------------------------------------------------------------------------------------

inline constexpr const char* state_class = R"(A run at one moment. It is good as long as `look` is called with it.
)";
inline constexpr const char* memm_class = R"(A solid under MEMM, step by step. It is made by `memm`.
)";
inline constexpr const char* clock_class = R"(Times that a host dictates to a run. It is made by `clock` of the run.
)";
inline constexpr const char* clock_state_class = R"(A state to which `restore` of a clock goes back.
)";

inline constexpr const char* memm_step = R"(Takes steps. Ctrl-C ends them.

Parameters
----------
n : int, default 1
    Number of steps.

Returns
-------
None

Raises
------
Diverged
    If a position is not finite, or moves too far.
TooDeep
    If faces are pressed in deeper than `compression_limit`.
)";

inline constexpr const char* memm_set_step = R"(Sets another dt from the next step on.

Parameters
----------
dt : float
    Length of the steps [s].
change : {'keep', 'restart'}
    'keep' is for slow and smooth changes, 'restart' for abrupt ones.

Returns
-------
None

Raises
------
BadInput
    If the step is above the stable one and the run has no `allow_unstable`.
ValueError
    If `change` is another word.
)";

inline constexpr const char* memm_set_traction = R"(Sets the tractions on a group of `outside`, until they are set again.

Parameters
----------
group : str
    Name of the group.
traction : array of float, (n_faces, dim)
    Traction on each of its faces [Pa].

Returns
-------
None

Raises
------
BadInput
    If there is no such group, or a traction is not finite.
)";

inline constexpr const char* memm_faces = R"(Tells where the faces of a group of `outside` are, and how they move.

Parameters
----------
group : str
    Name of the group.

Returns
-------
dict
    position [m] and velocity [m/s] of the centroids, normal, area at rest [m^(dim-1)], bonded: the share of it that bonds
    hold to another body [-], traction [Pa] as set last, and motion [m]: how far the centroids go in the next step, whatever
    the traction.

Raises
------
BadInput
    If there is no such group.
)";

inline constexpr const char* memm_clock = R"(Makes a clock for times that a host dictates, while the solid keeps its dt.

Parameters
----------
impulse : {'as_given', 'trapezoid'}
    'as_given': the mean of the tractions acts in each step, and works are the same to round-off. 'trapezoid': that of
    loads at both nodes, for tractions that answer to the motion in a run without restarts.

Returns
-------
Clock2D or Clock3D
    To be made again after `remove_cells`.

Raises
------
ValueError
    If `impulse` is another word.
)";

inline constexpr const char* memm_remove_cells = R"(Goes on without some cells. The others keep their order, and dt stays.

Parameters
----------
cells : sequence of int
    Numbers of the cells in `mesh`.

Returns
-------
dict
    What has left: cells, mass [kg], momentum [kg m/s], and kinetic and potential energy (V before less V after) [J].

Raises
------
BadInput
    If there is no such cell, or none would be left.
)";

inline constexpr const char* memm_record = R"(Adds a row to the ledger. It costs about two forces.

Returns
-------
None

Raises
------
Diverged
    If the energy is not finite.
)";

inline constexpr const char* clock_advance = R"(Goes on by a time of any length. The run steps as nodes are passed.

Parameters
----------
d : float
    Time [s].

Returns
-------
None

Raises
------
BadInput
    If the time is negative or not finite.
Diverged
    If a position is not finite, or moves too far.
)";

inline constexpr const char* clock_motion = R"(Tells how far the centroids of a group go, whatever the traction.

Parameters
----------
group : str
    Name of the group.
d : float
    Time [s], at most `time_to_node`.

Returns
-------
ndarray of float, (n_faces, dim)
    Motion in this time [m].

Raises
------
BadInput
    If there is no such group, or the time is longer.
)";

inline constexpr const char* clock_faces = R"(Tells where the faces of a group of `outside` are now, and how they move.

Parameters
----------
group : str
    Name of the group.

Returns
-------
dict
    As `faces` of the run; motion is that until the next node [m].

Raises
------
BadInput
    If there is no such group.
)";

inline constexpr const char* clock_state = R"(Keeps the state for `restore`.

Returns
-------
ClockState2D or ClockState3D
    State of the run and the clock.
)";

inline constexpr const char* clock_restore = R"(Goes back, for a step that is rejected: what follows is bitwise identical.

Parameters
----------
state : ClockState2D or ClockState3D
    Result of `state`. The ledger keeps its rows.

Returns
-------
None

Raises
------
BadInput
    If the state is one of another time that the clock cannot go back to.
)";

inline constexpr const char* simulate = R"(Runs a scene of a mesh, materials and velocities.

Parameters
----------
)";
inline constexpr const char* memm = R"(Sets up the same under MEMM, to be taken step by step.

Options of steps and files are for `simulate`.

Parameters
----------
)";
inline constexpr const char* scene_parameters = R"(mesh : Mesh2D or Mesh3D
    Bodies.
materials : list of Material
    One per body; simulate takes one for all of them, too.
velocity : array of float, (n_bodies, dim)
    Velocity of each body at the start [m/s]; simulate begins at rest without it.
acceleration : array of float, (n_bodies, dim), optional
    Acceleration by gravity [m/s^2].
held : dict of array of float, (dim,)
    Displacement of groups that are held [m].
rollers : list of str
    Groups that are held along their normals.
traction : dict of array of float, (dim,)
    Traction on groups [Pa].
temperature_rise : dict of float or of callable (t, x) -> float
    By body, the temperature above that without thermal strain [K]. A function is asked for each cell in each step.
displacement, added_velocity : callable (x) -> array of float, (dim,), optional
    Displacement [m] and further velocity [m/s] at the start, by position.
contact : bool, default True
    False lets bodies pass through each other.
)";
inline constexpr const char* simulate_parameters = R"(energy_scale : float, optional
    Energy over which figures are quoted [J]; by default the largest in play so far.
look : callable (state), optional
    Called at the start and after each step; True makes the next one the last.
**kwargs
    Options, those of the command line of `abut run` with _ for -. `out` is a folder for energy.csv, pictures and the
    VTU series.
)";
inline constexpr const char* memm_parameters = R"(outside : list of str
    Groups that `set_traction` loads.
**kwargs
    Options, those of the command line of `abut run` with _ for -.
)";
inline constexpr const char* simulate_returns = R"(
Returns
-------
Result
    Ledger, frames, forces and figures of the run.

Other Parameters
----------------
)";
inline constexpr const char* simulate_end = R"(
Raises
------
BadInput
    If something of the scene or an option cannot be used.
Diverged, TooDeep
    If the run cannot go on.

Examples
--------
>>> from abut import solid
>>> block = solid.structured_box((0, 0), (1, 1), (4, 4))
>>> rubber = solid.Material(young=1.0, poisson=0.3, density=1.0)
>>> result = solid.simulate(block, [rubber], [[0.1, 0.0]], steps=10)
>>> result.steps, result.complete
(10, True)
)";
inline constexpr const char* memm_returns = R"(
Returns
-------
Memm2D or Memm3D
    The solid at the start.

Other Parameters
----------------
)";
inline constexpr const char* memm_end = R"(
Raises
------
BadInput
    If something of the scene or an option cannot be used.

Examples
--------
>>> from abut import solid
>>> block = solid.structured_box((0, 0), (1, 1), (4, 4))
>>> run = solid.memm(block, [solid.Material(young=1.0, poisson=0.3, density=1.0)], [[0.1, 0.0]])
>>> run.step(10)
>>> run.steps
10
)";

}  // namespace abut::python::docs
