! forces <scene> <file>: as forces.c, from Fortran.
program forces
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use abut
  implicit none

  integer(c_int32_t) :: head(3), step
  integer(c_int32_t), allocatable, target :: corners(:, :), body(:), offsets(:)
  real(c_double), allocatable, target :: depth(:), x_0(:, :), x_1(:, :), f(:, :)
  real(c_double), target :: stiffness(2), shear_stiffness(2)
  type(abut_pair), allocatable :: pairs(:)
  type(abut_pair) :: none(0)
  type(abut_face_friction), allocatable :: rubbing(:)
  type(abut_face_friction) :: no_face(0)
  type(abut_options), target :: options
  type(abut_faces) :: faces
  type(abut_step_result) :: result
  type(abut_error) :: error
  type(c_ptr) :: contact
  character(1024) :: scene, file
  integer(c_int64_t) :: n, n_rubbing
  integer :: in, out, i

  call get_command_argument(1, scene)
  call get_command_argument(2, file)
  open (newunit=in, file=scene, access='stream', form='unformatted', status='old', action='read')
  open (newunit=out, file=file, access='stream', form='unformatted', status='replace', action='write')
  read (in) head
  allocate (corners(4, head(2)), body(head(2)), depth(head(2)), x_0(3, head(1)), x_1(3, head(1)), f(3, head(1)))
  call abut_options_init(options)
  read (in) corners, body, depth, stiffness, shear_stiffness, options%friction, x_0
  corners = corners + 1
  body = body + 1
  offsets = [(4*i + 1, i=0, head(2))]
  faces = abut_faces_of(corners, body, depth, stiffness, shear_stiffness)
  faces%offsets = c_loc(offsets)

  call check(abut_create(3, abut_points(x_0), faces, c_loc(options), contact, error))
  do step = 0, head(3) - 1
    read (in) x_1
    f = 0
    call check(abut_step(contact, 0.01d0, abut_points(x_0), abut_points(x_1), merge(abut_mean, abut_end, modulo(step, 2) == 0), &
      abut_points(f), result, error))
    call check(abut_pairs(contact, none, storage_size(none)/8_c_size_t, 0_c_int64_t, n, error))
    if (allocated(pairs)) deallocate (pairs)
    allocate (pairs(n))
    call check(abut_pairs(contact, pairs, storage_size(none)/8_c_size_t, size(pairs, kind=c_int64_t), n, error))
    call check(abut_friction(contact, no_face, storage_size(no_face)/8_c_size_t, 0_c_int64_t, n_rubbing, error))
    if (allocated(rubbing)) deallocate (rubbing)
    allocate (rubbing(n_rubbing))
    call check(abut_friction(contact, rubbing, storage_size(no_face)/8_c_size_t, size(rubbing, kind=c_int64_t), n_rubbing, error))
    write (out) f, result%energy_0, result%energy, real(n, c_double), result%friction_energy, result%dissipated, &
      real(n_rubbing, c_double)
    do i = 1, int(n)
      associate (p => pairs(i))
        write (out) real([p%face_1, p%face_2] - 1, c_double), p%normal, p%gap_0, p%gap_1, p%area, p%normal_force, p%force, &
          p%active_share, p%compression, p%friction, p%slip, p%point
      end associate
    end do
    do i = 1, int(n_rubbing)
      associate (r => rubbing(i))
        write (out) real(r%face - 1, c_double), r%normal_force, r%force, r%limit, r%slip, r%dissipated
      end associate
    end do
    x_0 = x_1
  end do
  call abut_destroy(contact)
  deallocate (corners, body, offsets, depth, x_0, x_1, f, pairs, rubbing)  ! a main program keeps them, which a sanitizer takes for a leak

contains

  subroutine check(status)
    integer(c_int), intent(in) :: status
    if (status == abut_ok) return
    write (error_unit, '(a)') abut_message(error)
    error stop 1
  end subroutine
end program
