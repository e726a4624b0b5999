! A solid at times that another code dictates, in Fortran: a gas of its own steps presses the end of an elastic bar.
!
! The bar is 1 m long, E = 1 Pa, rho = 1 kg/m^3, and its waves run at c = 1 m/s. The gas has p = p_0 - Z v at a wall that gives way
! with v. Until the wave comes back at 2 s the bar has v = p/(rho c), hence v = p_0/(Z + rho c): 0.8 m/s times 1e-3. The gas takes
! steps of 0.1 to 0.7 of those of the bar. Work is traction times motion, and the bar books the same, to round-off.
program dictated_times
  use, intrinsic :: iso_c_binding
  use abut
  use abut_solid
  implicit none

  integer, parameter :: rows = 2
  real(c_double), parameter :: end = 1.5d0, p_0 = 1d-3, answer = 0.25d0  ! [s], [Pa], Z [kg/(m^2 s)]
  character(*), parameter :: wall = 'xmin'
  real(c_double), target :: area(rows), motion(2, rows), traction(2, rows)
  real(c_double) :: moved = 0, work = 0, fraction = 0, time, time_to_node, speed
  type(c_ptr) :: solid
  type(abut_error) :: error
  type(abut_solid_options), target :: options
  type(abut_solid_face_arrays) :: faces
  type(abut_solid_state) :: state

  call check(abut_solid_create(2, solid, error))
  call check(abut_solid_add_box(solid, abut_text('bar'), [0d0, 0d0], [1d0, 0.02d0], [100, rows], abut_material(1d0, 0d0, 1d0), &
    c_null_ptr, error))
  call check(abut_solid_load(solid, abut_text(wall), c_null_ptr, error))
  options%restart = 20  ! the traction answers to the motion
  call check(abut_solid_begin(solid, c_loc(options), error))
  call check(abut_solid_begin_clock(solid, abut_as_given, error))
  faces%n_faces = rows
  faces%area = c_loc(area)
  call check(abut_solid_faces(solid, abut_text(wall), faces, error))
  call check(abut_solid_get_state(solid, state, error))

  do
    call check(abut_solid_clock(solid, time, time_to_node, error))
    if (time >= end) exit
    fraction = modulo(fraction + 0.618d0, 1d0)
    call take_step(min((0.1d0 + 0.6d0*fraction)*state%dt, time_to_node))
  end do
  call take_step(time_to_node)  ! to the end of a step of the bar
  call check(abut_solid_get_state(solid, state, error))
  speed = moved/state%time
  print '(a,f6.3,a,f6.3,a)', 'speed of the wall ', speed/p_0, ' p_0/(rho c), expected ', 1/(1 + answer), ' p_0/(rho c)'
  print '(a,i0,a,es8.1)', 'steps of the bar ', state%steps, ', works differ by ', abs(work - state%work_steps)/work
  if (abs(speed*(1 + answer)/p_0 - 1) > 0.01d0) error stop 'the wall has another speed'
  if (abs(work - state%work_steps) > 1d-12*work) error stop 'the works differ'
  call abut_solid_destroy(solid)

contains

  ! One step of the gas: the wall moves, the gas answers, the bar goes on.
  subroutine take_step(d)
    real(c_double), intent(in) :: d
    call check(abut_solid_motion(solid, abut_text(wall), d, abut_points(motion), error))
    traction(1, :) = p_0 - answer*motion(1, :)/d
    traction(2, :) = 0
    work = work + sum(area*traction(1, :)*motion(1, :))
    moved = moved + sum(motion(1, :))/rows
    call check(abut_solid_set_traction(solid, abut_text(wall), abut_points(traction), error))
    call check(abut_solid_advance(solid, d, error))
  end subroutine

  subroutine check(status)
    integer(c_int), intent(in) :: status
    if (status == abut_ok) return
    print '(a)', abut_message(error)
    error stop
  end subroutine
end program
