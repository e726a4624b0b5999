! A finite element code in Fortran with contact by Abut: two discs of triangles run into each other off centre and slip off.
!
! R = E = rho = 1, nu = 0.3, plane strain, small strain, at +-0.05 along x, centres 0.8 apart along y; central differences. Other
! codes of this kind find that the left disc leaves at (-0.0279, -0.0400). Prints its velocity; fails if it is 1 % off.
program slipping_discs
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  use abut
  implicit none

  integer, parameter :: rings = 13, disc_nodes = 1 + 3*rings*(rings + 1), disc_elements = 6*rings**2, disc_faces = 6*rings
  integer, parameter :: n_nodes = 2*disc_nodes, n_elements = 2*disc_elements, n_faces = 2*disc_faces
  real(c_double), parameter :: lambda = 0.3d0/(1.3d0*0.4d0), mu = 0.5d0/1.3d0, pi = acos(-1d0)
  real(c_double), target :: rest(2, n_nodes), x(2, n_nodes), next(2, n_nodes), f(2, n_nodes), stiffness(2), depth(n_faces)
  real(c_double) :: v(2, n_nodes), mass(n_nodes), slope(2, 3, n_elements), area(n_elements), k, time, left(2)
  integer(c_int32_t), target :: face(2, n_faces), body(n_faces)
  integer :: element(3, n_elements), steps, i
  type(abut_error) :: error
  type(abut_step_result) :: result
  type(abut_stable) :: stable
  type(abut_report) :: report
  type(abut_faces) :: faces
  type(c_ptr) :: contact

  mass = 0
  call make_disc(0, 0d0, 0d0, 0d0)
  call make_disc(1, sqrt(2.02d0**2 - 0.8d0**2), 0.8d0, 0.1d0)

  call check(abut_skin_stiffness(lambda + 2*mu, depth, int(n_faces, c_int64_t), k, error))
  stiffness = k
  faces = abut_faces_of(face, body, depth, stiffness)
  call check(abut_create(2, abut_points(rest), faces, c_null_ptr, contact, error))
  call check(abut_stable_step(contact, mass, int(n_nodes, c_int64_t), highest_frequency(), stable, error))

  x = rest
  v = 0
  v(1, :disc_nodes) = 0.05d0  ! at half steps
  v(1, disc_nodes + 1:) = -0.05d0
  time = 0
  steps = 0
  do while (time < 15)
    next = x + stable%dt*v
    f = 0
    call check(abut_step(contact, stable%dt, abut_points(x), abut_points(next), abut_end, abut_points(f), result, error))
    x = next
    call add_elastic_forces()
    do i = 1, n_nodes
      v(:, i) = v(:, i) + stable%dt*f(:, i)/mass(i)
    end do
    time = time + stable%dt
    steps = steps + 1
  end do

  do i = 1, 2
    left(i) = sum(mass(:disc_nodes)*v(i, :disc_nodes))/sum(mass(:disc_nodes))
  end do
  call check(abut_get_report(contact, report, error))
  print '(i0,a,f6.4,a,f8.4,a,f8.4,a,es8.1,a,i0,a)', steps, ' steps of ', stable%dt, ', left disc: (', left(1), ', ', left(2), &
    '), momentum of both ', norm2([sum(mass*v(1, :)), sum(mass*v(2, :))]), ', ', report%missed_contacts, ' missed'
  call abut_destroy(contact)
  if (norm2(left - [-0.0279d0, -0.0400d0]) > 0.01d0*0.0488d0 .or. report%missed_contacts /= 0) error stop 1

contains

  subroutine check(status)
    integer(c_int), intent(in) :: status
    if (status == abut_ok) return
    write (error_unit, '(a)') abut_message(error)
    error stop 1
  end subroutine

  ! Node j of ring r, which has 6 r of them; the centre is ring 0.
  pure integer function node(r, j)
    integer, intent(in) :: r, j
    node = 1
    if (r > 0) node = 2 + 3*r*(r - 1) + modulo(j, 6*r)
  end function

  subroutine make_disc(b, x_0, y_0, turn)
    integer, intent(in) :: b
    real(c_double), intent(in) :: x_0, y_0, turn
    integer :: first, e, r, side, j, out, in, n(3), i, last_element(0:disc_faces - 1)
    real(c_double) :: angle, p(2), q(2)
    first = b*disc_nodes
    do r = 0, rings
      do j = 0, max(1, 6*r) - 1
        angle = turn
        if (r > 0) angle = 2*pi*j/(6*r) + turn
        rest(:, first + node(r, j)) = [x_0, y_0] + real(r, c_double)/rings*[cos(angle), sin(angle)]
      end do
    end do
    e = b*disc_elements
    do r = 1, rings
      do side = 0, 5
        do j = 0, r - 1
          out = side*r + j
          in = side*(r - 1) + j
          e = e + 1
          if (r == rings) last_element(out) = e
          element(:, e) = first + [node(r - 1, in), node(r, out), node(r, out + 1)]
          if (j == r - 1) cycle
          e = e + 1
          element(:, e) = first + [node(r - 1, in), node(r, out + 1), node(r - 1, in + 1)]
        end do
      end do
    end do
    do e = b*disc_elements + 1, (b + 1)*disc_elements
      n = element(:, e)
      do i = 1, 3  ! of the shape functions, times twice the area
        p = rest(:, n(modulo(i, 3) + 1))
        q = rest(:, n(modulo(i + 1, 3) + 1))
        slope(:, i, e) = [p(2) - q(2), q(1) - p(1)]
      end do
      area(e) = 0.5d0*(slope(1, 2, e)*slope(2, 3, e) - slope(2, 2, e)*slope(1, 3, e))
      slope(:, :, e) = slope(:, :, e)/(2*area(e))
      mass(n) = mass(n) + area(e)/3
    end do
    do j = 0, disc_faces - 1
      i = b*disc_faces + j + 1
      face(:, i) = int(first + [node(rings, j), node(rings, j + 1)], c_int32_t)
      body(i) = int(b + 1, c_int32_t)
      depth(i) = area(last_element(j))/norm2(rest(:, face(2, i)) - rest(:, face(1, i)))  ! half the height of the element
    end do
  end subroutine

  ! Of linear elasticity, at x.
  subroutine add_elastic_forces()
    real(c_double) :: g(2, 2), stress(2, 2), trace
    integer :: e, i
    do e = 1, n_elements
      g = matmul(x(:, element(:, e)) - rest(:, element(:, e)), transpose(slope(:, :, e)))
      trace = lambda*(g(1, 1) + g(2, 2))
      stress = mu*(g + transpose(g))
      stress(1, 1) = stress(1, 1) + trace
      stress(2, 2) = stress(2, 2) + trace
      do i = 1, 3
        f(:, element(i, e)) = f(:, element(i, e)) - area(e)*matmul(stress, slope(:, i, e))
      end do
    end do
  end subroutine

  ! The largest eigenvalue of M^-1 K is at most the largest one of an element, and that is at most its trace.
  real(c_double) function highest_frequency()
    integer :: e
    highest_frequency = 0
    do e = 1, n_elements
      highest_frequency = max(highest_frequency, 3*(lambda + 3*mu)*sum(slope(:, :, e)**2))
    end do
    highest_frequency = sqrt(highest_frequency)
  end function
end program
