! Solids in contact that another program drives, for Fortran 2003: the functions of abut_solid.h under their own names.
! docs/loads.md has the equations, abut_solid.h says what each function does; compile this file after abut.f90.
!
! Names are given as abut_text('bar.xmin'). Variables of these types are ready for use, as those of abut.f90 are; arrays are views,
! abut_points(u) of u(dim, n), and those that are not set are not written.
module abut_solid
  use, intrinsic :: iso_c_binding
  use abut, only: abut_array, abut_error
  implicit none
  private

  integer(c_int32_t), parameter, public :: abut_keep = 0, abut_restart_momenta = 1
  integer(c_int32_t), parameter, public :: abut_as_given = 0, abut_trapezoid = 1

  type(abut_array), parameter :: nowhere = abut_array(c_null_ptr, 0_c_int64_t, 0_c_int64_t, 0_c_int64_t)

  type, bind(c), public :: abut_material
    real(c_double) :: young = 0, poisson = 0, density = 0
  end type

  type, bind(c), public :: abut_solid_options
    integer(c_size_t) :: struct_size = 56
    real(c_double) :: dt = 0, cfl = 0.9d0
    integer(c_int32_t) :: contact = 1, restart = 0
    real(c_double) :: friction = 0
    type(c_funptr) :: log = c_null_funptr
    type(c_ptr) :: user = c_null_ptr
  end type

  type, bind(c), public :: abut_solid_face_arrays
    integer(c_size_t) :: struct_size = 160
    integer(c_int64_t) :: n_faces = 0
    type(abut_array) :: position = nowhere, velocity = nowhere, normal = nowhere, motion = nowhere
    type(c_ptr) :: area = c_null_ptr, bonded = c_null_ptr
  end type

  type, bind(c), public :: abut_fracture
    integer(c_size_t) :: struct_size = 48
    real(c_double) :: grain = 0, strength = 0, fracture_energy = 0, weibull = 0
    integer(c_int32_t) :: seed = 0
  end type

  type, bind(c), public :: abut_solid_cell_arrays
    integer(c_size_t) :: struct_size = 128
    integer(c_int64_t) :: n_cells = 0
    type(abut_array) :: position = nowhere, velocity = nowhere, stress = nowhere
    type(c_ptr) :: plastic_strain = c_null_ptr, fragment = c_null_ptr
  end type

  type, bind(c), public :: abut_solid_fragment_arrays
    integer(c_size_t) :: struct_size = 128
    integer(c_int64_t) :: n_fragments = 0
    type(abut_array) :: centre = nowhere, velocity = nowhere, spin = nowhere
    type(c_ptr) :: mass = c_null_ptr, n_cells = c_null_ptr
  end type

  type, bind(c), public :: abut_solid_state
    integer(c_size_t) :: struct_size = 176
    integer(c_int64_t) :: steps = 0
    real(c_double) :: time = 0, dt = 0, stable_dt = 0, pseudo_energy = 0, energy = 0, kinetic = 0, work_steps = 0, &
      work_changes = 0, work_held = 0, restart_jumps = 0, parasitic = 0
    integer(c_int64_t) :: active_pairs = 0, missed_contacts = 0
    real(c_double) :: dissipated = 0, friction_energy = 0
    integer(c_int64_t) :: sticking_faces = 0, sliding_faces = 0
    real(c_double) :: broken_bonds = 0, work_heat = 0, beyond_fracture_energy = 0
  end type

  public :: abut_solid_create, abut_solid_add_box, abut_solid_add_file, abut_solid_clamp, abut_solid_roller, &
    abut_solid_load, abut_solid_bond, abut_solid_set_fracture, abut_solid_set_number, abut_solid_set_text, &
    abut_solid_set_numbers, abut_solid_n_fragments, abut_solid_fragments, &
    abut_solid_set_temperature, abut_solid_begin, abut_solid_n_faces, abut_solid_faces, abut_solid_set_traction, &
    abut_solid_n_cells, abut_solid_cells, abut_solid_set_step, abut_solid_step, abut_solid_begin_clock, &
    abut_solid_clock, abut_solid_motion, abut_solid_advance, abut_solid_keep, abut_solid_go_back, &
    abut_solid_get_state, abut_solid_get_number, abut_solid_destroy, abut_rise, abut_text

  ! Temperature of a body above its stress-free one [K], at a time and a position at rest.
  abstract interface
    real(c_double) function abut_rise(time, position, user) bind(c)
      import
      real(c_double), value :: time
      real(c_double), intent(in) :: position(*)
      type(c_ptr), value :: user
    end function
  end interface

  interface
    integer(c_int) function abut_solid_create(dim, solid, error) bind(c)
      import
      integer(c_int32_t), value :: dim
      type(c_ptr), intent(out) :: solid
      type(abut_error), intent(inout) :: error
    end function
    subroutine abut_solid_destroy(solid) bind(c)
      import
      type(c_ptr), value :: solid
    end subroutine
    ! velocity: c_loc of dim numbers, or c_null_ptr
    integer(c_int) function abut_solid_add_box(solid, name, lower, upper, counts, material, velocity, error) bind(c)
      import
      type(c_ptr), value :: solid
      character(kind=c_char), intent(in) :: name(*)
      real(c_double), intent(in) :: lower(*), upper(*)
      integer(c_int32_t), intent(in) :: counts(*)
      type(abut_material), value :: material
      type(c_ptr), value :: velocity
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_add_file(solid, path, material, velocity, error) bind(c)
      import
      type(c_ptr), value :: solid
      character(kind=c_char), intent(in) :: path(*)
      type(abut_material), value :: material
      type(c_ptr), value :: velocity
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_clamp(solid, group, error) bind(c)
      import
      type(c_ptr), value :: solid
      character(kind=c_char), intent(in) :: group(*)
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_roller(solid, group, error) bind(c)
      import
      type(c_ptr), value :: solid
      character(kind=c_char), intent(in) :: group(*)
      type(abut_error), intent(inout) :: error
    end function
    ! traction: c_loc of dim numbers, or c_null_ptr
    integer(c_int) function abut_solid_load(solid, group, traction, error) bind(c)
      import
      type(c_ptr), value :: solid
      character(kind=c_char), intent(in) :: group(*)
      type(c_ptr), value :: traction
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_bond(solid, side_1, side_2, strength, fracture_energy, error) bind(c)
      import
      type(c_ptr), value :: solid
      character(kind=c_char), intent(in) :: side_1(*), side_2(*)
      real(c_double), value :: strength, fracture_energy
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_set_fracture(solid, body, fracture, error) bind(c)
      import
      type(c_ptr), value :: solid
      character(kind=c_char), intent(in) :: body(*)
      type(abut_fracture), intent(in) :: fracture
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_set_number(solid, body, key, value, error) bind(c)
      import
      type(c_ptr), value :: solid
      character(kind=c_char), intent(in) :: body(*), key(*)
      real(c_double), value :: value
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_set_text(solid, body, key, text, error) bind(c)
      import
      type(c_ptr), value :: solid
      character(kind=c_char), intent(in) :: body(*), key(*), text(*)
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_set_numbers(solid, body, key, numbers, n, error) bind(c)
      import
      type(c_ptr), value :: solid
      character(kind=c_char), intent(in) :: body(*), key(*)
      real(c_double), intent(in) :: numbers(*)
      integer(c_int64_t), value :: n
      type(abut_error), intent(inout) :: error
    end function
    ! rise: c_funloc of an abut_rise
    integer(c_int) function abut_solid_set_temperature(solid, body, rise, varies, user, error) bind(c)
      import
      type(c_ptr), value :: solid
      character(kind=c_char), intent(in) :: body(*)
      type(c_funptr), value :: rise
      integer(c_int32_t), value :: varies
      type(c_ptr), value :: user
      type(abut_error), intent(inout) :: error
    end function
    ! options: c_loc of abut_solid_options, or c_null_ptr
    integer(c_int) function abut_solid_begin(solid, options, error) bind(c)
      import
      type(c_ptr), value :: solid
      type(c_ptr), value :: options
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_n_faces(solid, group, n, error) bind(c)
      import
      type(c_ptr), value :: solid
      character(kind=c_char), intent(in) :: group(*)
      integer(c_int64_t), intent(out) :: n
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_faces(solid, group, faces, error) bind(c)
      import
      type(c_ptr), value :: solid
      character(kind=c_char), intent(in) :: group(*)
      type(abut_solid_face_arrays), intent(inout) :: faces  ! arrays behind it are written
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_set_traction(solid, group, traction, error) bind(c)
      import
      type(c_ptr), value :: solid
      character(kind=c_char), intent(in) :: group(*)
      type(abut_array), value :: traction
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_n_cells(solid, body, n, error) bind(c)
      import
      type(c_ptr), value :: solid
      character(kind=c_char), intent(in) :: body(*)
      integer(c_int64_t), intent(out) :: n
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_cells(solid, body, cells, error) bind(c)
      import
      type(c_ptr), value :: solid
      character(kind=c_char), intent(in) :: body(*)
      type(abut_solid_cell_arrays), intent(inout) :: cells  ! arrays behind it are written
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_n_fragments(solid, n, error) bind(c)
      import
      type(c_ptr), value :: solid
      integer(c_int64_t), intent(out) :: n
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_fragments(solid, fragments, error) bind(c)
      import
      type(c_ptr), value :: solid
      type(abut_solid_fragment_arrays), intent(inout) :: fragments  ! arrays behind it are written
      type(abut_error), intent(inout) :: error
    end function
    ! change: abut_keep or abut_restart_momenta
    integer(c_int) function abut_solid_set_step(solid, dt, change, error) bind(c)
      import
      type(c_ptr), value :: solid
      real(c_double), value :: dt
      integer(c_int32_t), value :: change
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_step(solid, error) bind(c)
      import
      type(c_ptr), value :: solid
      type(abut_error), intent(inout) :: error
    end function
    ! impulse: abut_as_given or abut_trapezoid
    integer(c_int) function abut_solid_begin_clock(solid, impulse, error) bind(c)
      import
      type(c_ptr), value :: solid
      integer(c_int32_t), value :: impulse
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_clock(solid, time, time_to_node, error) bind(c)
      import
      type(c_ptr), value :: solid
      real(c_double), intent(out) :: time, time_to_node
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_motion(solid, group, d, motion, error) bind(c)
      import
      type(c_ptr), value :: solid
      character(kind=c_char), intent(in) :: group(*)
      real(c_double), value :: d
      type(abut_array), value :: motion
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_advance(solid, d, error) bind(c)
      import
      type(c_ptr), value :: solid
      real(c_double), value :: d
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_keep(solid, error) bind(c)
      import
      type(c_ptr), value :: solid
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_go_back(solid, error) bind(c)
      import
      type(c_ptr), value :: solid
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_get_state(solid, state, error) bind(c)
      import
      type(c_ptr), value :: solid
      type(abut_solid_state), intent(inout) :: state
      type(abut_error), intent(inout) :: error
    end function
    integer(c_int) function abut_solid_get_number(solid, column, value, error) bind(c)
      import
      type(c_ptr), value :: solid
      character(kind=c_char), intent(in) :: column(*)
      real(c_double), intent(out) :: value
      type(abut_error), intent(inout) :: error
    end function
  end interface

contains

  ! A text as C takes it.
  function abut_text(text) result(with_end)
    character(*), intent(in) :: text
    character(len(text) + 1, kind=c_char) :: with_end
    with_end = text // c_null_char
  end function
end module
