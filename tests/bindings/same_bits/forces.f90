! forces <scene> <file>: as forces.c, from Fortran.
program forces
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use abut
  implicit none

  integer(c_int32_t) :: head(3), step
  integer(c_int32_t), allocatable, target :: corners(:, :), body(:), offsets(:)
  real(c_double), allocatable, target :: depth(:), x_0(:, :), x_1(:, :), f(:, :)
  real(c_double), target :: stiffness(2)
  type(abut_pair), allocatable :: pairs(:)
  type(abut_pair) :: none(0)
  type(abut_faces) :: faces
  type(abut_step_result) :: result
  type(abut_error) :: error
  type(c_ptr) :: contact
  character(1024) :: scene, file
  integer(c_int64_t) :: n
  integer :: in, out, i

  call get_command_argument(1, scene)
  call get_command_argument(2, file)
  open (newunit=in, file=scene, access='stream', form='unformatted', status='old', action='read')
  open (newunit=out, file=file, access='stream', form='unformatted', status='replace', action='write')
  read (in) head
  allocate (corners(4, head(2)), body(head(2)), depth(head(2)), x_0(3, head(1)), x_1(3, head(1)), f(3, head(1)))
  read (in) corners, body, depth, stiffness, x_0
  corners = corners + 1
  body = body + 1
  offsets = [(4*i + 1, i=0, head(2))]
  faces = abut_faces_of(corners, body, depth, stiffness)
  faces%offsets = c_loc(offsets)

  error = abut_new_error()
  result = abut_new_result()
  call check(abut_create(3, abut_points(x_0), faces, c_null_ptr, contact, error))
  do step = 0, head(3) - 1
    read (in) x_1
    f = 0
    call check(abut_step(contact, 1d0, abut_points(x_0), abut_points(x_1), merge(abut_mean, abut_end, modulo(step, 2) == 0), &
      abut_points(f), result, error))
    call check(abut_pairs(contact, none, storage_size(none)/8_c_size_t, 0_c_int64_t, n, error))
    if (allocated(pairs)) deallocate (pairs)
    allocate (pairs(n))
    call check(abut_pairs(contact, pairs, storage_size(none)/8_c_size_t, size(pairs, kind=c_int64_t), n, error))
    write (out) f, result%energy_0, result%energy, real(n, c_double)
    do i = 1, int(n)
      associate (p => pairs(i))
        write (out) real([p%face_1, p%face_2] - 1, c_double), p%normal, p%gap_0, p%gap_1, p%area, p%normal_force, p%force, &
          p%active_share, p%compression
      end associate
    end do
    x_0 = x_1
  end do
  call abut_destroy(contact)
  deallocate (corners, body, offsets, depth, x_0, x_1, f, pairs)  ! a main program keeps them, which a sanitizer takes for a leak

contains

  subroutine check(status)
    integer(c_int), intent(in) :: status
    if (status == abut_ok) return
    write (error_unit, '(a)') abut_message(error)
    error stop 1
  end subroutine
end program
