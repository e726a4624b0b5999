! Contact in a solver of one's own, in Fortran: two squares of four nodes each run into each other and part.
program two_squares
  use, intrinsic :: iso_c_binding
  use abut
  implicit none
  ! Two unit squares, 0.05 m apart; faces run so that their body lies to the left
  real(c_double), target :: rest(2, 8) = reshape([0d0, 0d0, 1d0, 0d0, 1d0, 1d0, 0d0, 1d0, &
    1.05d0, 0.1d0, 2.05d0, 0.1d0, 2.05d0, 1.1d0, 1.05d0, 1.1d0], [2, 8])
  integer(c_int32_t), target :: nodes(2, 8) = reshape([1, 2, 2, 3, 3, 4, 4, 1, 5, 6, 6, 7, 7, 8, 8, 5], [2, 8])
  integer(c_int32_t), target :: body(8) = [1, 1, 1, 1, 2, 2, 2, 2]
  real(c_double), target :: depth(8) = 0.5d0  ! [m] half the height of the element behind a face
  real(c_double), target :: stiffness(2), x_0(2, 8), x_1(2, 8), force(2, 8)
  real(c_double) :: v(2, 8), mass(8) = 0.25d0, k  ! [kg/m] of each node
  integer :: step, b, i, s
  type(c_ptr) :: contact
  type(abut_error) :: error
  type(abut_stable) :: stable
  type(abut_step_result) :: result
  type(abut_report) :: report

  s = abut_skin_stiffness(1d0, depth, 8_c_int64_t, k, error)  ! lambda + 2 mu = 1 Pa
  stiffness = k
  if (abut_create(2, abut_points(rest), abut_faces_of(nodes, body, depth, stiffness), c_null_ptr, contact, error) /= abut_ok) &
    error stop 'create'
  s = abut_stable_step(contact, mass, 8_c_int64_t, 2d0, stable, error)  ! 2 rad/s: the fastest swing of a square alone
  x_0 = rest
  v = 0
  v(1, :) = [0.1d0, 0.1d0, 0.1d0, 0.1d0, -0.1d0, -0.1d0, -0.1d0, -0.1d0]
  do step = 1, ceiling(4/stable%dt)
    x_1 = x_0 + stable%dt*v
    force = 0
    s = abut_step(contact, stable%dt, abut_points(x_0), abut_points(x_1), abut_end, abut_points(force), result, error)
    if (s /= abut_ok) print *, abut_message(error)  ! the call above is all there is to contact
    do b = 1, 5, 4  ! your elements: here springs to the mean motion
      do i = 1, 2
        associate (u => x_1(i, b:b + 3) - rest(i, b:b + 3))
          force(i, b:b + 3) = force(i, b:b + 3) - u + sum(u)/4
        end associate
      end do
    end do
    v = v + stable%dt/mass(1)*force
    x_0 = x_1
  end do
  s = abut_get_report(contact, report, error)
  print '(2(a,f6.3,a,f6.3),a,i0)', 'left (', sum(v(1, :4))/4, ', ', sum(v(2, :4))/4, '), right (', sum(v(1, 5:))/4, ', ', &
    sum(v(2, 5:))/4, '), missed contacts: ', report%missed_contacts
  call abut_destroy(contact)
end program
