! step_cost <scene> <calls>: as step_cost.c, from Fortran.
program step_cost
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use abut
  implicit none

  integer(c_int32_t) :: head(2)
  integer(c_int32_t), allocatable, target :: corners(:, :), body(:)
  real(c_double), allocatable, target :: depth(:), x(:, :, :), f(:, :)
  real(c_double), target :: stiffness(2)
  type(abut_faces) :: faces
  type(abut_step_result) :: result
  type(abut_error) :: error
  type(c_ptr) :: contact
  character(1024) :: argument
  double precision :: start, end
  integer :: scene, calls, i

  call get_command_argument(1, argument)
  open (newunit=scene, file=argument, access='stream', form='unformatted', status='old', action='read')
  call get_command_argument(2, argument)
  read (argument, *) calls
  read (scene) head
  allocate (corners(3, head(2)), body(head(2)), depth(head(2)), x(3, head(1), 3), f(3, head(1)))
  read (scene) corners, body, depth, stiffness, x
  corners = corners + 1
  body = body + 1
  f = 0

  faces = abut_faces_of(corners, body, depth, stiffness)
  call check(abut_create(3, abut_points(x(:, :, 1)), faces, c_null_ptr, contact, error))
  call check(abut_step(contact, 1d0, abut_points(x(:, :, 1)), abut_points(x(:, :, 2)), abut_mean, abut_points(f), result, error))
  call cpu_time(start)
  do i = 1, calls
    call check(abut_step(contact, 1d0, abut_points(x(:, :, 2)), abut_points(x(:, :, 3)), abut_mean, abut_points(f), result, &
      error))
  end do
  call cpu_time(end)
  print '(f0.4,1x,i0,1x,es23.16)', 1d6*(end - start)/calls, result%active_pairs, result%energy
  call abut_destroy(contact)

contains

  subroutine check(status)
    integer(c_int), intent(in) :: status
    if (status == abut_ok) return
    write (error_unit, '(a)') abut_message(error)
    error stop 1
  end subroutine
end program
