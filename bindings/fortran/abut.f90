! Contact between deformable solids whose surfaces are made of nodes, for Fortran 2003: the functions of abut.h under their own
! names, with arrays u(dim, n) as they lie. docs/languages.md walks through it; abut.h says what each function does.
!
! Indices count from 1 if `index_base` of the faces is 1, as `abut_faces_of` sets it. Variables of these types are ready for use:
! `struct_size` has the size of the type in C, which tests/bindings/test_abut.f90 compares with c_sizeof. Options alone begin with
! a call of `abut_options_init`.
module abut
  use, intrinsic :: iso_c_binding
  implicit none
  private

  integer(c_int), parameter, public :: abut_ok = 0, abut_bad_input = 1, abut_misuse = 2, abut_diverged = 3, &
    abut_too_deep = 4, abut_limit_exceeded = 5, abut_cancelled = 6, abut_callback = 7, abut_out_of_memory = 8, abut_internal = 9
  integer(c_int32_t), parameter, public :: abut_mean = 0, abut_end = 1

  type, bind(c), public :: abut_error
    integer(c_size_t) :: struct_size = 1072
    integer(c_int32_t) :: status = abut_ok
    integer(c_int64_t) :: face_1 = -1, face_2 = -1
    real(c_double) :: value = 0, allowed = 0
    character(kind=c_char) :: message(1024) = c_null_char
  end type

  type, bind(c), public :: abut_array
    type(c_ptr) :: data
    integer(c_int64_t) :: count, item, component
  end type

  type, bind(c), public :: abut_faces
    integer(c_size_t) :: struct_size = 88
    integer(c_int64_t) :: n_faces = 0
    type(c_ptr) :: nodes = c_null_ptr
    integer(c_int64_t) :: n_nodes = 0
    type(c_ptr) :: offsets = c_null_ptr, body = c_null_ptr, depth = c_null_ptr, stiffness = c_null_ptr, &
      shear_stiffness = c_null_ptr
    integer(c_int64_t) :: n_bodies = 0
    integer(c_int32_t) :: index_base = 1
  end type

  type, bind(c), public :: abut_cells
    integer(c_size_t) :: struct_size = 56
    integer(c_int64_t) :: n_cells = 0
    type(c_ptr) :: nodes = c_null_ptr
    integer(c_int64_t) :: n_nodes = 0
    type(c_ptr) :: offsets = c_null_ptr, body = c_null_ptr
    integer(c_int32_t) :: index_base = 1
  end type

  type, bind(c), public :: abut_friction_law
    real(c_double) :: friction, sliding_friction, decay_speed, decay_slip, shear_strength, relaxation_time
  end type

  type, bind(c), public :: abut_options
    integer(c_size_t) :: struct_size
    real(c_double) :: skin, largest_motion
    integer(c_int64_t) :: max_pairs
    real(c_double) :: compression_warning, compression_limit, facing_full, facing_none
    real(c_double) :: friction, sliding_friction, decay_speed, decay_slip, shear_strength, relaxation_time
    integer(c_int32_t) :: events, gauss, self_contact
    type(c_funptr) :: wanted, law_of
    type(c_ptr) :: laws
    integer(c_int64_t) :: n_laws
    type(c_funptr) :: own_coefficient
    real(c_double) :: interference_time
    type(c_funptr) :: interferes, cancel, log
    type(c_ptr) :: user
  end type

  type, bind(c), public :: abut_step_result
    integer(c_size_t) :: struct_size = 104
    real(c_double) :: energy_0 = 0, energy = 0, work = 0
    integer(c_int64_t) :: active_pairs = 0, events = 0
    real(c_double) :: compression = 0, correction = 0, friction_energy = 0, dissipated = 0
    integer(c_int64_t) :: sticking_faces = 0, sliding_faces = 0
    real(c_double) :: interference_work = 0
  end type

  type, bind(c), public :: abut_pair
    integer(c_int32_t) :: face_1, face_2
    real(c_double) :: normal(3), gap_0, gap_1, area, normal_force, force(3)
    integer(c_int32_t) :: events
    real(c_double) :: active_share, compression, friction(3), slip(3), point(3)
  end type

  type, bind(c), public :: abut_face_friction
    integer(c_int32_t) :: face
    real(c_double) :: normal_force, force, limit, slip, dissipated
  end type

  type, bind(c), public :: abut_body
    integer(c_int32_t) :: body
    real(c_double) :: force(3), moment(3), work
  end type

  type, bind(c), public :: abut_body_pair
    integer(c_int32_t) :: body_1, body_2
    integer(c_int64_t) :: active_pairs
    real(c_double) :: force(3), normal_force
  end type

  type, bind(c), public :: abut_report
    integer(c_size_t) :: struct_size = 176
    integer(c_int64_t) :: candidates = 0, candidates_max = 0, active_pairs = 0, active_pairs_max = 0, events = 0, rebuilds = 0, &
      missed_contacts = 0, inadmissible_overlaps = 0, compressed_steps = 0, tilted_pairs_max = 0
    real(c_double) :: compression_max = 0, correction_max = 0, friction_dissipated = 0, least_dissipated = 0, &
      friction_ratio_max = 0, sliding_force = 0, sliding_limit = 0
    integer(c_int64_t) :: sticking_faces = 0, sliding_faces = 0, sticking_faces_max = 0, sliding_faces_max = 0
  end type

  type, bind(c), public :: abut_stable
    integer(c_size_t) :: struct_size = 296
    real(c_double) :: dt = 0, omega = 0, omega_free = 0
    integer(c_int64_t) :: node = -1
    character(kind=c_char) :: reason(256) = c_null_char
  end type

  type, bind(c), public :: abut_overlap
    integer(c_int32_t) :: face_1, face_2
    real(c_double) :: area, normal(3), gap, distance
  end type

  public :: abut_options_init, abut_limit_threads, abut_skin_stiffness, abut_create, abut_destroy, abut_step, abut_evaluate, &
    abut_pairs, abut_bodies, abut_body_pairs, abut_friction, abut_get_report, abut_stable_step, abut_save, abut_restore, &
    abut_replace_surface, abut_find_overlaps, abut_surface_of, abut_surface_faces, abut_surface_destroy
  public :: abut_version, abut_wanted, abut_interferes, abut_law_of, abut_own_coefficient, abut_cancel, abut_log, abut_columns
  public :: abut_points, abut_nothing, abut_faces_of, abut_cells_of, abut_message

  ! What the callbacks of abut_options look like: options%wanted = c_funloc(mine), options%user = c_loc(my_data).
  abstract interface
    integer(c_int) function abut_wanted(face_1, face_2, user) bind(c)
      import
      integer(c_int32_t), value :: face_1, face_2
      type(c_ptr), value :: user
    end function
    integer(c_int) function abut_interferes(face_1, face_2, user) bind(c)
      import
      integer(c_int32_t), value :: face_1, face_2
      type(c_ptr), value :: user
    end function
    integer(c_int32_t) function abut_law_of(face_1, face_2, user) bind(c)
      import
      integer(c_int32_t), value :: face_1, face_2
      type(c_ptr), value :: user
    end function
    real(c_double) function abut_own_coefficient(speed, slid, pressure, user) bind(c)
      import
      real(c_double), value :: speed, slid, pressure
      type(c_ptr), value :: user
    end function
    integer(c_int) function abut_cancel(user) bind(c)
      import
      type(c_ptr), value :: user
    end function
    subroutine abut_log(severity, text, user) bind(c)
      import
      integer(c_int), value :: severity
      character(kind=c_char), intent(in) :: text(*)  ! up to c_null_char
      type(c_ptr), value :: user
    end subroutine
  end interface

  interface
    subroutine abut_options_init(options) bind(c)
      import
      type(abut_options), intent(out) :: options
    end subroutine
    integer(c_int) function abut_limit_threads(n, error) bind(c)
      import
      integer(c_int32_t), value :: n
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_skin_stiffness(modulus, depth, n, stiffness, error) bind(c)
      import
      real(c_double), value :: modulus
      real(c_double), intent(in) :: depth(*)
      integer(c_int64_t), value :: n
      real(c_double), intent(out) :: stiffness
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_surface_of(dim, rest, cells, surface, error) bind(c)
      import
      integer(c_int32_t), value :: dim
      type(abut_array), value :: rest
      type(abut_cells), intent(in) :: cells
      type(c_ptr), intent(out) :: surface
      type(abut_error), intent(inout) :: error
    end function
    ! cell: for c_f_pointer to (n_faces) integers of c_int32_t
    integer(c_int) function abut_surface_faces(surface, faces, cell, error) bind(c)
      import
      type(c_ptr), value :: surface
      type(abut_faces), intent(inout) :: faces
      type(c_ptr), intent(out) :: cell
      type(abut_error), intent(inout) :: error
    end function
    subroutine abut_surface_destroy(surface) bind(c)
      import
      type(c_ptr), value :: surface
    end subroutine
    ! options: c_loc of abut_options, or c_null_ptr
    integer(c_int) function abut_create(dim, rest, faces, options, contact, error) bind(c)
      import
      integer(c_int32_t), value :: dim
      type(abut_array), value :: rest
      type(abut_faces), intent(in) :: faces
      type(c_ptr), value :: options
      type(c_ptr), intent(out) :: contact
      type(abut_error), intent(inout) :: error
    end function
    subroutine abut_destroy(contact) bind(c)
      import
      type(c_ptr), value :: contact
    end subroutine
    integer(c_int) function abut_step(contact, dt, x_0, x_1, take, force, result, error) bind(c)
      import
      type(c_ptr), value :: contact
      real(c_double), value :: dt
      type(abut_array), value :: x_0, x_1, force
      integer(c_int32_t), value :: take
      type(abut_step_result), intent(inout) :: result
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_evaluate(contact, x, force, energy, error) bind(c)
      import
      type(c_ptr), value :: contact
      type(abut_array), value :: x, force
      real(c_double), intent(out) :: energy
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_pairs(contact, pairs, entry_size, capacity, n, error) bind(c)
      import
      type(c_ptr), value :: contact
      type(abut_pair), intent(inout) :: pairs(*)
      integer(c_size_t), value :: entry_size
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: n  ! may be the argument `capacity` as well
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_bodies(contact, bodies, entry_size, capacity, n, error) bind(c)
      import
      type(c_ptr), value :: contact
      type(abut_body), intent(inout) :: bodies(*)
      integer(c_size_t), value :: entry_size
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: n  ! may be the argument `capacity` as well
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_body_pairs(contact, pairs, entry_size, capacity, n, error) bind(c)
      import
      type(c_ptr), value :: contact
      type(abut_body_pair), intent(inout) :: pairs(*)
      integer(c_size_t), value :: entry_size
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: n  ! may be the argument `capacity` as well
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_friction(contact, faces, entry_size, capacity, n, error) bind(c)
      import
      type(c_ptr), value :: contact
      type(abut_face_friction), intent(inout) :: faces(*)
      integer(c_size_t), value :: entry_size
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: n  ! may be the argument `capacity` as well
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_get_report(contact, report, error) bind(c)
      import
      type(c_ptr), value :: contact
      type(abut_report), intent(inout) :: report
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_stable_step(contact, mass, n, omega_free, stable, error) bind(c)
      import
      type(c_ptr), value :: contact
      real(c_double), intent(in) :: mass(*)
      integer(c_int64_t), value :: n
      real(c_double), value :: omega_free
      type(abut_stable), intent(inout) :: stable
      type(abut_error), intent(inout) :: error
    end function
    ! bytes: of any kind; capacity 0 asks for the size alone
    integer(c_int) function abut_save(contact, bytes, capacity, n, error) bind(c)
      import
      type(c_ptr), value :: contact
      character(kind=c_char), intent(inout) :: bytes(*)
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: n  ! may be the argument `capacity` as well
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_restore(contact, bytes, n, error) bind(c)
      import
      type(c_ptr), value :: contact
      character(kind=c_char), intent(in) :: bytes(*)
      integer(c_int64_t), value :: n
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_replace_surface(contact, rest, faces, old_face_of, error) bind(c)
      import
      type(c_ptr), value :: contact
      type(abut_array), value :: rest
      type(abut_faces), intent(in) :: faces
      integer(c_int32_t), intent(in) :: old_face_of(*)
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_find_overlaps(dim, x, faces, distance, overlaps, entry_size, capacity, n, error) bind(c)
      import
      integer(c_int32_t), value :: dim
      type(abut_array), value :: x
      type(abut_faces), intent(in) :: faces
      real(c_double), value :: distance
      type(abut_overlap), intent(inout) :: overlaps(*)
      integer(c_size_t), value :: entry_size
      integer(c_int64_t), value :: capacity
      integer(c_int64_t), intent(inout) :: n  ! may be the argument `capacity` as well
      type(abut_error), intent(inout) :: error
    end function
  end interface

contains

  ! A view of u(dim, n), whatever its strides: nothing is copied.
  function abut_points(u) result(points)
    real(c_double), target, intent(in) :: u(:, :)
    type(abut_array) :: points
    points%data = c_null_ptr
    points%count = size(u, 2, c_int64_t)
    points%item = size(u, 1)
    points%component = 1
    if (size(u) == 0) return
    points%data = c_loc(u(1, 1))
    if (size(u, 2) > 1) points%item = apart(c_loc(u(1, 1)), c_loc(u(1, 2)))
    if (size(u, 1) > 1) points%component = apart(c_loc(u(1, 1)), c_loc(u(2, 1)))
  contains
    integer(c_int64_t) function apart(from, to)
      type(c_ptr), intent(in) :: from, to
      apart = (transfer(to, 0_c_intptr_t) - transfer(from, 0_c_intptr_t)) / 8
    end function
  end function

  ! A view of u(n, dim), one array per component.
  function abut_columns(u) result(points)
    real(c_double), target, intent(in) :: u(:, :)
    type(abut_array) :: points
    points = abut_points(u)
    points%count = size(u, 1, c_int64_t)
    points = abut_array(points%data, points%count, points%component, points%item)
  end function

  ! "0.1.0"
  function abut_version() result(text)
    character(:), allocatable :: text
    character(kind=c_char), pointer :: bytes(:)
    type(c_ptr) :: from
    integer(c_size_t) :: n, i
    interface
      type(c_ptr) function c_version() bind(c, name='abut_version')
        import
      end function
      integer(c_size_t) function strlen(from) bind(c)
        import
        type(c_ptr), value :: from
      end function
    end interface
    from = c_version()
    n = strlen(from)
    call c_f_pointer(from, bytes, [n])
    allocate (character(n) :: text)
    do i = 1, n
      text(i:i) = bytes(i)
    end do
  end function

  ! For a force that is not asked for.
  function abut_nothing() result(points)
    type(abut_array) :: points
    points = abut_array(c_null_ptr, 0_c_int64_t, 0_c_int64_t, 0_c_int64_t)
  end function

  ! Faces of as many corners as dimensions, nodes(corner, face); all counts from 1. The arrays must stay while it is used.
  ! `shear_stiffness`: needed with friction, as long as `stiffness`.
  function abut_faces_of(nodes, body, depth, stiffness, shear_stiffness) result(faces)
    integer(c_int32_t), target, contiguous, intent(in) :: nodes(:, :), body(:)
    real(c_double), target, contiguous, intent(in) :: depth(:), stiffness(:)
    real(c_double), target, contiguous, intent(in), optional :: shear_stiffness(:)
    type(abut_faces) :: faces
    faces%n_faces = size(body, kind=c_int64_t)
    faces%nodes = c_loc(nodes)
    faces%n_nodes = size(nodes, kind=c_int64_t)
    faces%body = c_loc(body)
    faces%depth = c_loc(depth)
    faces%stiffness = c_loc(stiffness)
    if (present(shear_stiffness)) faces%shear_stiffness = c_loc(shear_stiffness)
    faces%n_bodies = size(stiffness, kind=c_int64_t)
  end function

  ! All cells with as many corners: nodes(corners, n), counted from 1 as bodies are.
  function abut_cells_of(nodes, body) result(cells)
    integer(c_int32_t), target, contiguous, intent(in) :: nodes(:, :)
    integer(c_int32_t), target, contiguous, intent(in), optional :: body(:)
    type(abut_cells) :: cells
    cells%n_cells = size(nodes, 2, c_int64_t)
    cells%nodes = c_loc(nodes)
    cells%n_nodes = size(nodes, kind=c_int64_t)
    if (present(body)) cells%body = c_loc(body)
  end function

  ! The text of an error.
  function abut_message(error) result(text)
    type(abut_error), intent(in) :: error
    character(:), allocatable :: text
    integer :: i
    text = ''
    do i = 1, size(error%message)
      if (error%message(i) == c_null_char) exit
      text = text // error%message(i)
    end do
  end function
end module
