! Every function of the module abut_solid, called from Fortran 2008. A bar that cannot widen, pressed at one end: until a wave comes
! back the end gives way with v = p/(rho c), c = sqrt((lambda + 2 mu)/rho).
module test_solid_host
  use, intrinsic :: iso_c_binding
  implicit none
  private
  public :: warm, counts

contains

  ! A kelvin per metre along x, as many times as `user` says.
  real(c_double) function warm(time, position, user) bind(c)
    real(c_double), value :: time
    real(c_double), intent(in) :: position(*)
    type(c_ptr), value :: user
    real(c_double), pointer :: factor
    call c_f_pointer(user, factor)
    warm = factor*position(1)*(1 + 0*time)
  end function

  subroutine counts(severity, text, user) bind(c)
    integer(c_int), value :: severity
    character(kind=c_char), intent(in) :: text(*)
    type(c_ptr), value :: user
    integer, pointer :: told
    call c_f_pointer(user, told)
    if (severity == 1 .and. text(1) /= c_null_char) told = told + 1
  end subroutine
end module

program test_abut_solid
  use, intrinsic :: iso_c_binding
  use abut
  use abut_solid
  use test_solid_host
  implicit none

  integer, parameter :: cells = 80, rows = 2
  real(c_double), parameter :: pressure = 1d-3, young = 52d0/70, poisson = 0.3d0  ! lambda + 2 mu = 1, c = 1
  character(*), parameter :: pressed = 'bar.xmin'
  integer :: failures = 0
  type(abut_error) :: error

  call types_have_the_sizes_of_c()
  call a_pressed_bar_gives_way_and_gets_the_work()
  call a_step_that_is_taken_again_has_the_same_bits()
  call bodies_have_what_is_set_for_them()
  call a_body_that_may_break_is_one_fragment_before()
  call a_file_that_is_not_there_is_named()
  if (failures > 0) error stop

contains

  subroutine expect(holds, what)
    logical, intent(in) :: holds
    character(*), intent(in) :: what
    if (holds) return
    failures = failures + 1
    print '(3a)', 'failed: ', what, '; the last error: ' // abut_message(error)
  end subroutine

  subroutine succeeds(status, what)
    integer(c_int), intent(in) :: status
    character(*), intent(in) :: what
    call expect(status == abut_ok, what)
  end subroutine

  subroutine types_have_the_sizes_of_c()
    type(abut_solid_options) :: options
    type(abut_solid_face_arrays) :: faces
    type(abut_solid_cell_arrays) :: of_cells
    type(abut_solid_state) :: state
    type(abut_fracture) :: fracture
    type(abut_solid_fragment_arrays) :: fragments
    call expect(fracture%struct_size == c_sizeof(fracture), 'size of abut_fracture')
    call expect(fragments%struct_size == c_sizeof(fragments), 'size of abut_solid_fragment_arrays')
    call expect(options%struct_size == c_sizeof(options), 'size of abut_solid_options')
    call expect(faces%struct_size == c_sizeof(faces), 'size of abut_solid_face_arrays')
    call expect(of_cells%struct_size == c_sizeof(of_cells), 'size of abut_solid_cell_arrays')
    call expect(state%struct_size == c_sizeof(state), 'size of abut_solid_state')
  end subroutine

  function bar_before_a_wall() result(solid)
    type(c_ptr) :: solid
    type(abut_material) :: material
    real(c_double), target :: none(2)
    material = abut_material(young, poisson, 1d0)
    none = 0
    call succeeds(abut_solid_create(2, solid, error), 'create')
    call succeeds(abut_solid_add_box(solid, abut_text('bar'), [0d0, 0d0], [2d0, 0.05d0], [cells, rows], material, c_loc(none), &
      error), 'add_box')
    call succeeds(abut_solid_add_box(solid, abut_text('wall'), [2.1d0, 0d0], [3.1d0, 0.05d0], [30, 3], material, c_null_ptr, &
      error), 'add_box')
    call succeeds(abut_solid_roller(solid, abut_text('bar.ymin'), error), 'roller')
    call succeeds(abut_solid_roller(solid, abut_text('bar.ymax'), error), 'roller')
    call succeeds(abut_solid_clamp(solid, abut_text('wall.xmax'), error), 'clamp')
    call succeeds(abut_solid_load(solid, abut_text(pressed), c_null_ptr, error), 'load')
  end function

  subroutine a_pressed_bar_gives_way_and_gets_the_work()
    type(c_ptr) :: solid
    type(abut_solid_options), target :: options
    type(abut_solid_state) :: state
    type(abut_solid_face_arrays) :: faces
    real(c_double), target :: position(2, rows), velocity(2, rows), normal(2, rows), motion(2, rows), area(rows), traction(2, rows)
    real(c_double) :: start, work, kinetic
    integer(c_int64_t) :: n
    integer, target :: told
    told = 0
    solid = bar_before_a_wall()
    options%log = c_funloc(counts)
    options%user = c_loc(told)
    call succeeds(abut_solid_begin(solid, c_loc(options), error), 'begin')
    call succeeds(abut_solid_n_faces(solid, abut_text(pressed), n, error), 'n_faces')
    call expect(n == rows, 'the pressed end has two faces')
    faces%n_faces = n
    faces%position = abut_points(position)
    faces%velocity = abut_points(velocity)
    faces%normal = abut_points(normal)
    faces%motion = abut_points(motion)
    faces%area = c_loc(area)
    traction(1, :) = pressure
    traction(2, :) = 0
    call succeeds(abut_solid_set_traction(solid, abut_text(pressed), abut_points(traction), error), 'set_traction')
    call succeeds(abut_solid_get_state(solid, state, error), 'get_state')
    start = state%pseudo_energy
    work = 0
    do while (state%time < 1)
      call succeeds(abut_solid_faces(solid, abut_text(pressed), faces, error), 'faces')
      work = work + sum(area*traction(1, :)*motion(1, :))
      call succeeds(abut_solid_step(solid, error), 'step')
      call succeeds(abut_solid_get_state(solid, state, error), 'get_state')
    end do
    call succeeds(abut_solid_faces(solid, abut_text(pressed), faces, error), 'faces')
    call expect(all(abs(normal(1, :) + 1) < 1d-12) .and. abs(sum(area) - 0.05d0) < 1d-14, 'normals and areas of the end')
    call expect(all(abs(position(1, :)/(pressure*state%time) - 1) < 0.02d0), 'the end is at p t/(rho c)')
    call expect(abs(sum(velocity(1, :))/rows/pressure - 1) < 0.05d0, 'the end moves with p/(rho c)')
    call expect(abs(state%work_steps - work) <= 1d-12*work .and. work > 0, 'work is traction times motion')
    call expect(abs(state%pseudo_energy + state%work_held - start - state%work_steps - state%work_changes) <= 1d-12*work, &
      'H~ is the work')
    call expect(state%missed_contacts == 0 .and. state%active_pairs == 0, 'nothing touches yet')
    call succeeds(abut_solid_get_number(solid, abut_text('kinetic'), kinetic, error), 'get_number')
    call expect(kinetic == state%kinetic, 'a number of the ledger is that of the state')
    call succeeds(abut_solid_set_step(solid, 0.5d0*state%dt, abut_keep, error), 'set_step')
    call expect(told == 1, 'a step that jumps is warned of')
    call succeeds(abut_solid_set_step(solid, state%dt, abut_restart_momenta, error), 'set_step')
    call expect(abut_solid_set_step(solid, -1d0, abut_keep, error) == abut_bad_input, 'a step < 0 is refused')
    call abut_solid_destroy(solid)
  end subroutine

  subroutine a_step_that_is_taken_again_has_the_same_bits()
    type(c_ptr) :: solid
    real(c_double), target :: motion(2, rows), again(2, rows), traction(2, rows)
    real(c_double) :: time, time_to_node, d
    solid = bar_before_a_wall()
    call succeeds(abut_solid_begin(solid, c_null_ptr, error), 'begin')
    call succeeds(abut_solid_begin_clock(solid, abut_trapezoid, error), 'begin_clock')
    traction(1, :) = pressure
    traction(2, :) = 0
    call succeeds(abut_solid_set_traction(solid, abut_text(pressed), abut_points(traction), error), 'set_traction')
    call succeeds(abut_solid_clock(solid, time, time_to_node, error), 'clock')
    call expect(time == 0 .and. time_to_node > 0, 'a clock begins at a node')
    call succeeds(abut_solid_advance(solid, 3.7d0*time_to_node, error), 'advance')
    call succeeds(abut_solid_keep(solid, error), 'keep')
    call later(solid, motion)
    call succeeds(abut_solid_go_back(solid, error), 'go_back')
    call later(solid, again)
    call expect(all(motion == again) .and. all(motion(1, :) > 0), 'the same bits')
    call succeeds(abut_solid_clock(solid, time, time_to_node, error), 'clock')
    d = 2*time_to_node
    call expect(abut_solid_motion(solid, abut_text(pressed), d, abut_points(again), error) == abut_bad_input, &
      'motion beyond the node is refused')
    call abut_solid_destroy(solid)
  end subroutine

  ! A few steps on, the motion of the end until the next node.
  subroutine later(solid, found)
    type(c_ptr), intent(in) :: solid
    real(c_double), target, intent(out) :: found(2, rows)
    real(c_double) :: now, left
    call succeeds(abut_solid_advance(solid, 0.1d0, error), 'advance')
    call succeeds(abut_solid_clock(solid, now, left, error), 'clock')
    call succeeds(abut_solid_motion(solid, abut_text(pressed), left, abut_points(found), error), 'motion')
  end subroutine

  ! Heat that rises along x stretches the cells of a free bar without stress; a glued one does not part.
  subroutine bodies_have_what_is_set_for_them()
    type(c_ptr) :: solid
    type(abut_material) :: material
    type(abut_solid_cell_arrays) :: of_cells
    real(c_double), target :: factor, stress(4, cells), plastic(cells), position(2, cells), velocity(2, cells)
    type(abut_solid_state) :: state
    integer(c_int64_t) :: n
    material = abut_material(young, 0d0, 1d0)
    factor = 2
    call succeeds(abut_solid_create(2, solid, error), 'create')
    call succeeds(abut_solid_add_box(solid, abut_text('low'), [0d0, 0d0], [2d0, 0.1d0], [cells/2, 2], material, c_null_ptr, &
      error), 'add_box')
    call succeeds(abut_solid_add_box(solid, abut_text('high'), [0d0, 0.1d0], [2d0, 0.2d0], [30, 2], material, c_null_ptr, error), &
      'add_box')
    call succeeds(abut_solid_bond(solid, abut_text('low.ymax'), abut_text('high.ymin'), 1d0, 0d0, error), 'bond')
    call succeeds(abut_solid_set_text(solid, abut_text('low'), abut_text('law'), abut_text('j2'), error), 'set_text')
    call succeeds(abut_solid_set_text(solid, abut_text('low'), abut_text('kinematics'), abut_text('finite'), error), 'set_text')
    call succeeds(abut_solid_set_number(solid, abut_text('low'), abut_text('thermal_expansion'), 1d-5, error), 'set_number')
    call succeeds(abut_solid_set_numbers(solid, abut_text('low'), abut_text('hardening_table'), [0d0, 0.01d0, 0.1d0, 0.02d0], &
      4_c_int64_t, error), 'set_numbers')
    call succeeds(abut_solid_set_temperature(solid, abut_text('low'), c_funloc(warm), 0, c_loc(factor), error), 'set_temperature')
    call succeeds(abut_solid_begin(solid, c_null_ptr, error), 'begin')
    call succeeds(abut_solid_n_cells(solid, abut_text('low'), n, error), 'n_cells')
    call expect(n == cells, 'cells of a body')
    of_cells%n_cells = n
    of_cells%position = abut_points(position)
    of_cells%velocity = abut_points(velocity)
    of_cells%stress = abut_points(stress)
    of_cells%plastic_strain = c_loc(plastic)
    call succeeds(abut_solid_cells(solid, abut_text('low'), of_cells, error), 'cells')
    call expect(maxval(abs(stress)) > 1d-6 .and. all(velocity == 0) .and. all(plastic == 0), 'heat stresses cells that are at rest')
    call expect(abs(sum(position(2, :))/cells - 0.05d0) < 1d-12, 'cells are where the box is')
    call succeeds(abut_solid_get_state(solid, state, error), 'get_state')
    call expect(state%broken_bonds == 0, 'the bond holds')
    call expect(abut_solid_clamp(solid, abut_text('low.xmin'), error) == abut_misuse, 'nothing is added to a solid that has begun')
    call abut_solid_destroy(solid)
    call abut_solid_destroy(c_null_ptr)
  end subroutine

  ! A bar that nothing breaks is one fragment, with its mass and its velocity.
  subroutine a_body_that_may_break_is_one_fragment_before()
    type(c_ptr) :: solid
    type(abut_fracture) :: fracture
    type(abut_solid_fragment_arrays) :: fragments
    real(c_double), target :: mass(1), speed(2), velocity(2, 1)
    integer(c_int64_t), target :: n_cells(1)
    integer(c_int64_t) :: n
    speed = [1d-3, 0d0]
    fracture%grain = 0.2d0
    fracture%strength = 1
    call succeeds(abut_solid_create(2, solid, error), 'create')
    call succeeds(abut_solid_add_box(solid, abut_text('bar'), [0d0, 0d0], [2d0, 0.1d0], [cells/2, 2], &
      abut_material(young, 0d0, 1d0), c_loc(speed), error), 'add_box')
    call succeeds(abut_solid_set_fracture(solid, abut_text('bar'), fracture, error), 'set_fracture')
    call succeeds(abut_solid_set_text(solid, abut_text('bar'), abut_text('kinematics'), abut_text('floating'), error), 'set_text')
    call succeeds(abut_solid_begin(solid, c_null_ptr, error), 'begin')
    call succeeds(abut_solid_n_fragments(solid, n, error), 'n_fragments')
    call expect(n == 1, 'one fragment')
    fragments%n_fragments = n
    fragments%velocity = abut_points(velocity)
    fragments%mass = c_loc(mass)
    fragments%n_cells = c_loc(n_cells)
    call succeeds(abut_solid_fragments(solid, fragments, error), 'fragments')
    call expect(abs(mass(1) - 0.2d0) < 1d-12 .and. n_cells(1) == cells, 'its mass and cells')
    call expect(maxval(abs(velocity(:, 1) - speed)) < 1d-15, 'its velocity')
    call abut_solid_destroy(solid)
  end subroutine

  subroutine a_file_that_is_not_there_is_named()
    type(c_ptr) :: solid
    integer(c_int) :: status
    call succeeds(abut_solid_create(2, solid, error), 'create')
    status = abut_solid_add_file(solid, abut_text('nowhere.msh'), abut_material(1d0, 0d0, 1d0), c_null_ptr, error)
    call expect(status == abut_bad_input, 'a file that is not there is bad input')
    call expect(index(abut_message(error), 'nowhere.msh') > 0, 'a file that is not there is named')
    call abut_solid_destroy(solid)
  end subroutine
end program
