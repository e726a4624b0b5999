! Every function of the module, called from Fortran 2008. Two unit squares one over the other, as in test_abut.c: the
! expected values follow from their geometry.
module test_host
  use, intrinsic :: iso_c_binding
  implicit none
  private
  public :: never, cancels, listens, tells_law, tells_coefficient, fresh_host

  type, public :: host_type
    integer :: wanted, cancelled, told
    character(1024) :: text
  end type

contains

  function fresh_host() result(host)
    type(host_type) :: host
    host = host_type(0, 0, 0, '')
  end function

  function host_of(user) result(host)
    type(c_ptr), intent(in) :: user
    type(host_type), pointer :: host
    call c_f_pointer(user, host)
  end function

  integer(c_int) function never(face_1, face_2, user) bind(c)
    integer(c_int32_t), value :: face_1, face_2
    type(c_ptr), value :: user
    type(host_type), pointer :: host
    host => host_of(user)
    if (min(face_1, face_2) >= 1 .and. max(face_1, face_2) <= 8) host%wanted = host%wanted + 1
    never = 0
  end function

  integer(c_int) function cancels(user) bind(c)
    type(c_ptr), value :: user
    type(host_type), pointer :: host
    host => host_of(user)
    host%cancelled = host%cancelled + 1
    cancels = merge(1, 0, host%cancelled > 1)
  end function

  integer(c_int32_t) function tells_law(face_1, face_2, user) bind(c)
    integer(c_int32_t), value :: face_1, face_2
    type(c_ptr), value :: user
    type(host_type), pointer :: host
    host => host_of(user)
    host%wanted = 10*face_1 + face_2
    tells_law = 1
  end function

  real(c_double) function tells_coefficient(speed, slid, pressure, user) bind(c)
    real(c_double), value :: speed, slid, pressure
    type(c_ptr), value :: user
    type(host_type), pointer :: host
    host => host_of(user)
    if (min(speed, slid) >= 0 .and. pressure > 0) host%told = host%told + 1
    tells_coefficient = 0.375d0
  end function

  subroutine listens(severity, text, user) bind(c)
    integer(c_int), value :: severity
    character(kind=c_char), intent(in) :: text(*)
    type(c_ptr), value :: user
    type(host_type), pointer :: host
    integer :: i
    host => host_of(user)
    if (severity == 1) host%told = host%told + 1
    host%text = ''
    do i = 1, len(host%text)
      if (text(i) == c_null_char) exit
      host%text(i:i) = text(i)
    end do
  end subroutine
end module

program test_abut
  use, intrinsic :: iso_c_binding
  use, intrinsic :: ieee_arithmetic, only: ieee_quiet_nan, ieee_value
  use abut
  use test_host
  implicit none

  integer, parameter :: n_nodes = 8, n_faces = 8
  ! Counter-clockwise: the outside is on the right of each segment.
  real(c_double), target, save :: rest(2, n_nodes) = reshape([0.0d0, 0.0d0, 1.0d0, 0.0d0, 1.0d0, 1.0d0, 0.0d0, 1.0d0, &
    0.2d0, 1.1d0, 1.2d0, 1.1d0, 1.2d0, 2.1d0, 0.2d0, 2.1d0], [2, n_nodes])
  integer(c_int32_t), target, save :: corners(2, n_faces) = &
    reshape([1, 2, 2, 3, 3, 4, 4, 1, 5, 6, 6, 7, 7, 8, 8, 5], [2, n_faces])
  integer(c_int32_t), target, save :: body(n_faces) = [1, 1, 1, 1, 2, 2, 2, 2]
  real(c_double), target, save :: depth(n_faces) = 0.1d0, stiffness(2) = [3.0d0, 6.0d0]  ! in series: 2
  real(c_double), target, save :: shear_stiffness(2) = [1.0d0, 2.0d0]  ! in series: 2/3
  integer(c_int64_t), parameter :: zero = 0, one = 1, two = 2
  integer :: failures = 0
  type(abut_error) :: error
  type(abut_step_result) :: result

  call types_have_the_sizes_that_they_say()
  call presses_by_the_spring_in_series()
  call mean_force_is_exact_for_energy()
  call any_strides_are_read_and_written_in_place()
  call quadrangles_have_offsets()
  call state_goes_on_with_the_same_bits()
  call friction_sticks_by_the_shear_in_series()
  call laws_of_friction_are_told_by_pair()
  call surface_is_replaced()
  call callbacks_are_called()
  call what_is_wrong_is_refused_by_name()
  call overlaps_alone()
  call a_surface_is_found_of_cells()
  call small_things()
  print '(i0,a)', failures, ' failures'
  if (failures > 0) error stop 1

contains

  subroutine check(condition, what)
    logical, intent(in) :: condition
    character(*), intent(in) :: what
    if (condition) return
    print '(2a)', 'failed: ', what
    failures = failures + 1
  end subroutine

  subroutine types_have_the_sizes_that_they_say()
    type(abut_faces) :: faces
    type(abut_cells) :: cells
    type(abut_report) :: report
    type(abut_stable) :: stable
    call check(error%struct_size == c_sizeof(error), 'size of abut_error')
    call check(faces%struct_size == c_sizeof(faces), 'size of abut_faces')
    call check(cells%struct_size == c_sizeof(cells), 'size of abut_cells')
    call check(result%struct_size == c_sizeof(result), 'size of abut_step_result')
    call check(report%struct_size == c_sizeof(report), 'size of abut_report')
    call check(stable%struct_size == c_sizeof(stable), 'size of abut_stable')
    call check(abut_message(error) == '', 'an error without a text')
  end subroutine

  ! Statuses have a check of their own: Fortran may look at the other operands of an expression before it calls.
  subroutine expect(expected, status, what)
    integer(c_int), intent(in) :: expected, status
    character(*), intent(in) :: what
    if (status == expected) return
    print '(3a,i0,a,i0,2a)', 'failed: ', what, ': status ', status, ', expected ', expected, ': ', abut_message(error)
    failures = failures + 1
  end subroutine

  ! The upper square moved down by so much.
  pure function lowered(by) result(x)
    real(c_double), intent(in) :: by
    real(c_double) :: x(2, n_nodes)
    x = rest
    x(2, 5:) = x(2, 5:) - by
  end function

  type(abut_faces) function squares()
    squares = abut_faces_of(corners, body, depth, stiffness)
  end function

  function made(options) result(contact)
    type(c_ptr), intent(in) :: options
    type(c_ptr) :: contact
    call expect(abut_ok, abut_create(2, abut_points(rest), squares(), options, contact, error), 'create')
    call check(c_associated(contact), 'a handle')
  end function

  ! A contact that has begun, apart.
  function begun() result(contact)
    type(c_ptr) :: contact
    contact = made(c_null_ptr)
    call expect(abut_ok, step(contact, rest, rest), 'a step at rest')
  end function

  ! Of which only the figures in `result` are looked at.
  integer(c_int) function step(contact, x_0, x_1)
    type(c_ptr), intent(in) :: contact
    real(c_double), target, intent(in) :: x_0(:, :), x_1(:, :)
    step = abut_step(contact, 1d0, abut_points(x_0), abut_points(x_1), abut_mean, abut_nothing(), result, error)
  end function

  ! Pressed in by d over a width of 0.8: W = k/2 d^2 0.8, and the force is k d 0.8.
  subroutine presses_by_the_spring_in_series()
    real(c_double), parameter :: d = 0.05d0, k = 2
    real(c_double), target :: x(2, n_nodes), force(2, n_nodes)
    real(c_double) :: up, down, energy
    type(c_ptr) :: contact
    type(abut_pair) :: pairs(1), none(0)
    type(abut_body) :: bodies(2)
    type(abut_body_pair) :: of_bodies(1)
    type(abut_report) :: report
    integer(c_int64_t) :: n
    contact = begun()
    x = lowered(0.1d0 + d)
    force = 0
    call expect(abut_ok, abut_step(contact, 1d0, abut_points(rest), abut_points(x), abut_end, abut_points(force), result, &
      error), 'a step that presses in')
    call check(result%active_pairs == 1 .and. abs(result%energy - 0.5d0*k*d**2*0.8d0) < 1d-15, 'W = k/2 d^2 0.8')
    down = sum(force(2, :4))
    up = sum(force(2, 5:))
    call check(abs(up - k*d*0.8d0) < 1d-14 .and. abs(up + down) < 1d-15, 'the force is k d 0.8')

    call expect(abut_ok, abut_pairs(contact, none, c_sizeof(pairs(1)), zero, n, error), 'number of pairs')
    call check(n == 1, 'one pair')
    call expect(abut_ok, abut_pairs(contact, pairs, c_sizeof(pairs(1)), one, n, error), 'pairs')
    call check(pairs(1)%face_1 == 3 .and. pairs(1)%face_2 == 5, 'faces of a pair count from 1')
    call check(abs(pairs(1)%normal(2) - 1) < 1d-15 .and. pairs(1)%normal(3) == 0, 'normal of a pair')
    call check(abs(pairs(1)%gap_1 + d) < 1d-15 .and. abs(pairs(1)%area - 0.8d0) < 1d-15, 'gap and area of a pair')
    call check(abs(pairs(1)%force(2) - up) < 1d-15 .and. abs(pairs(1)%compression - d/0.2d0) < 1d-14, 'force of a pair')
    call expect(abut_misuse, abut_pairs(contact, pairs, c_sizeof(pairs(1)) - 8, one, n, error), 'another entry_size')

    call expect(abut_ok, abut_bodies(contact, bodies, c_sizeof(bodies(1)), two, n, error), 'bodies')
    call check(n == 2 .and. all(bodies%body == [1, 2]), 'bodies count from 1')
    call check(abs(bodies(1)%force(2) - down) < 1d-15 .and. abs(bodies(2)%force(2) - up) < 1d-15, 'forces on bodies')
    call expect(abut_ok, abut_body_pairs(contact, of_bodies, c_sizeof(of_bodies(1)), one, n, error), 'pairs of bodies')
    call check(n == 1 .and. of_bodies(1)%body_1 == 1 .and. of_bodies(1)%body_2 == 2, 'one pair of bodies')
    call check(of_bodies(1)%active_pairs == 1 .and. abs(of_bodies(1)%normal_force - up) < 1d-15, 'its force')

    call expect(abut_ok, abut_get_report(contact, report, error), 'report')
    call check(report%missed_contacts == 0 .and. report%active_pairs == 1 .and. report%rebuilds >= 1, 'its counters')

    x = lowered(0.1d0 + 2*d)
    force = 0
    call expect(abut_ok, abut_evaluate(contact, abut_points(x), abut_points(force), energy, error), 'evaluate')
    call check(abs(energy - 4*0.5d0*k*d**2*0.8d0) < 1d-14 .and. abs(sum(force(2, 5:)) - 2*up) < 1d-14, 'twice as deep')
    call abut_destroy(contact)
  end subroutine

  ! The mean of the force times the motion is the energy, whatever the step.
  subroutine mean_force_is_exact_for_energy()
    real(c_double), target :: x(2, n_nodes), force(2, n_nodes)
    type(c_ptr) :: contact
    contact = begun()
    x = lowered(0.17d0)
    x(2, 5) = x(2, 5) + 0.02d0  ! one corner less: it turns, too
    force = 0
    call expect(abut_ok, abut_step(contact, 1d0, abut_points(rest), abut_points(x), abut_mean, abut_points(force), result, &
      error), 'a step that turns')
    call check(result%energy > 1d-4 .and. abs(sum(force*(x - rest)) + result%energy - result%energy_0) < 1d-16, &
      'work of the mean force is what W loses')
    call abut_destroy(contact)
  end subroutine

  subroutine any_strides_are_read_and_written_in_place()
    real(c_double), target :: x(2, n_nodes), packed(2, n_nodes), wide(2, 3*n_nodes), wide_force(2, 3*n_nodes)
    real(c_double), target :: tall(5, n_nodes), tall_force(5, n_nodes), turned(2, n_nodes), turned_force(2, n_nodes)
    real(c_double), target :: columns(n_nodes, 2), columns_force(n_nodes, 2), no_points(2, 0)
    type(abut_array) :: view
    x = lowered(0.14d0)
    packed = 0
    call press(abut_points(x), abut_points(packed))
    call check(packed(2, 5) > 0, 'packed arrays are pressed in')

    wide = 0
    wide_force = 0
    wide(:, ::3) = x
    call press(abut_points(wide(:, ::3)), abut_points(wide_force(:, ::3)))
    call check(all(wide_force(:, ::3) == packed), 'every third node')
    call check(count(wide_force /= 0) == count(packed /= 0), 'nothing between them')

    tall = 0
    tall_force = 0
    tall(2:4:2, :) = x
    call press(abut_points(tall(2:4:2, :)), abut_points(tall_force(2:4:2, :)))
    call check(all(tall_force(2:4:2, :) == packed), 'rows 2 and 4')
    call check(count(tall_force /= 0) == count(packed /= 0), 'no other row')

    turned(2:1:-1, n_nodes:1:-1) = x
    turned_force = 0
    call press(abut_points(turned(2:1:-1, n_nodes:1:-1)), abut_points(turned_force(2:1:-1, n_nodes:1:-1)))
    call check(all(turned_force(2:1:-1, n_nodes:1:-1) == packed), 'backwards')

    columns = transpose(x)
    columns_force = 0
    call press(by_component(columns), by_component(columns_force))
    call check(all(transpose(columns_force) == packed), 'one array per component')

    view = abut_points(no_points)
    call check(.not. c_associated(view%data) .and. view%count == 0, 'no points')
    view = abut_points(x(:, 3:3))
    call check(c_associated(view%data, c_loc(x(1, 3))) .and. view%count == 1 .and. view%component == 1, 'one point')
  end subroutine

  ! u(n, dim).
  function by_component(u) result(view)
    real(c_double), target, contiguous, intent(in) :: u(:, :)
    type(abut_array) :: view
    view = abut_array(c_loc(u), size(u, 1, c_int64_t), 1_c_int64_t, size(u, 1, c_int64_t))
  end function

  ! By value, as the module passes views: behind an intent(in) gfortran takes the points as unchanged.
  subroutine press(x, force)
    type(abut_array), value :: x, force
    type(c_ptr) :: contact
    contact = begun()
    call expect(abut_ok, abut_step(contact, 1d0, abut_points(rest), x, abut_mean, force, result, error), 'a step that presses in')
    call abut_destroy(contact)
  end subroutine

  ! Two unit cubes, the upper one aside by 0.1 and 0.05, and pressed in by 0.03.
  subroutine quadrangles_have_offsets()
    integer(c_int32_t), parameter :: cube(24) = [1, 3, 4, 2, 5, 6, 8, 7, 1, 2, 6, 5, 3, 7, 8, 4, 1, 5, 7, 3, 2, 4, 8, 6]
    integer(c_int32_t), target :: nodes(4, 12), offsets(13), of_body(12)
    real(c_double), target :: x_0(3, 16), x_1(3, 16), depths(12)
    type(abut_faces) :: faces
    type(c_ptr) :: contact
    integer :: i
    nodes = reshape([cube, cube + 8], [4, 12])
    offsets = [(4*i + 1, i = 0, 12)]
    of_body = [(1, i = 1, 6), (2, i = 1, 6)]
    depths = 0.1d0
    do i = 0, 7
      x_0(:, i + 1) = [ibits(i, 0, 1), ibits(i, 1, 1), ibits(i, 2, 1)]
      x_0(:, i + 9) = x_0(:, i + 1) + [0.1d0, 0.05d0, 1.02d0]
    end do
    x_1 = x_0
    x_1(3, 9:) = x_1(3, 9:) - 0.05d0
    faces = abut_faces_of(nodes, of_body, depths, stiffness)
    faces%offsets = c_loc(offsets)
    call expect(abut_ok, abut_create(3, abut_points(x_0), faces, c_null_ptr, contact, error), 'cubes')
    call expect(abut_ok, step(contact, x_0, x_0), 'cubes at rest')
    call expect(abut_ok, step(contact, x_0, x_1), 'cubes that press in')
    call check(abs(result%energy - 0.5d0*2*0.03d0**2*0.9d0*0.95d0) < 1d-15, 'W of cubes')
    call abut_destroy(contact)
  end subroutine

  subroutine state_goes_on_with_the_same_bits()
    real(c_double), target :: y(2, n_nodes), z(2, n_nodes), force(2, n_nodes), other(2, n_nodes)
    character(kind=c_char), allocatable :: bytes(:)
    character(kind=c_char) :: none(0)
    type(c_ptr) :: contact, again
    integer(c_int64_t) :: n
    contact = begun()
    again = made(c_null_ptr)
    y = lowered(0.15d0)
    z = lowered(0.16d0)
    force = 0
    other = 0
    call expect(abut_ok, step(contact, rest, y), 'a step before the state')
    call expect(abut_ok, abut_save(contact, none, zero, n, error), 'size of a state')
    call check(n > 0, 'a state has bytes')
    allocate (bytes(n))
    call expect(abut_ok, abut_save(contact, bytes, size(bytes, kind=c_int64_t), n, error), 'save')
    call expect(abut_ok, abut_restore(again, bytes, n, error), 'restore')
    call expect(abut_ok, abut_step(contact, 1d0, abut_points(y), abut_points(z), abut_mean, abut_points(force), result, error), &
      'a step after the state')
    call expect(abut_ok, abut_step(again, 1d0, abut_points(y), abut_points(z), abut_mean, abut_points(other), result, error), &
      'the same step')
    call check(all(force == other) .and. force(2, 5) > 0, 'the same bits')
    bytes(n/2) = achar(ieor(iachar(bytes(n/2)), 1))
    call expect(abut_bad_input, abut_restore(again, bytes, n, error), 'damaged bytes')
    call expect(abut_bad_input, abut_restore(again, bytes, 3_c_int64_t, error), 'too few bytes')
    call abut_destroy(contact)
    call abut_destroy(again)
  end subroutine

  ! Made with friction, and pressed in.
  function rubbing(options) result(contact)
    type(abut_options), target, intent(in) :: options
    type(abut_faces) :: faces
    type(c_ptr) :: contact
    faces = abut_faces_of(corners, body, depth, stiffness, shear_stiffness)
    call expect(abut_ok, abut_create(2, abut_points(rest), faces, c_loc(options), contact, error), 'with friction')
    call expect(abut_ok, step(contact, rest, lowered(0.15d0)), 'a step that presses in')
  end function

  ! Both faces, of length 1, stick by half of the 2/3 of the pair.
  subroutine friction_sticks_by_the_shear_in_series()
    real(c_double), parameter :: s = 0.003d0, kappa = 2d0/3d0
    real(c_double), target :: x(2, n_nodes)
    type(abut_options), target :: options
    type(abut_pair) :: pairs(1)
    type(abut_face_friction) :: of_faces(2)
    type(abut_report) :: report
    type(c_ptr) :: contact
    integer(c_int64_t) :: n
    call abut_options_init(options)
    options%friction = 0.5d0
    contact = rubbing(options)
    x = lowered(0.15d0)
    x(1, 5:) = x(1, 5:) + s
    call expect(abut_ok, step(contact, lowered(0.15d0), x), 'a step aside')
    call check(abs(result%friction_energy - 0.5d0*kappa*s**2) < 1d-17 .and. abs(result%dissipated) < 1d-17, 'energy of stick')
    call check(result%sticking_faces == 2 .and. result%sliding_faces == 0, 'both faces stick')
    call expect(abut_ok, abut_pairs(contact, pairs, c_sizeof(pairs(1)), one, n, error), 'pairs with friction')
    call check(all(abs(pairs(1)%friction - [-0.5d0*kappa*s, 0d0, 0d0]) < 1d-15), 'friction of a pair')
    call check(all(abs(pairs(1)%slip - [s, 0d0, 0d0]) < 1d-15), 'slip of a pair')
    call expect(abut_ok, abut_friction(contact, of_faces, c_sizeof(of_faces(1)), two, n, error), 'friction of faces')
    call check(n == 2 .and. all(of_faces%face == [3, 5]), 'faces with friction')
    call check(all(abs(of_faces%force - 0.25d0*kappa*s) < 1d-15) .and. all(of_faces%slip == 0), 'their force')
    call expect(abut_ok, abut_get_report(contact, report, error), 'a report with friction')
    call check(report%sticking_faces == 2 .and. report%sticking_faces_max == 2 .and. report%sliding_faces_max == 0, 'its faces')
    call abut_destroy(contact)
  end subroutine

  subroutine laws_of_friction_are_told_by_pair()
    type(abut_options), target :: options
    type(abut_friction_law), target :: laws(1)
    type(abut_face_friction) :: of_faces(2)
    type(host_type), target :: host
    type(c_ptr) :: contact
    integer(c_int64_t) :: n
    host = fresh_host()
    call abut_options_init(options)
    laws(1) = abut_friction_law(0.25d0, options%sliding_friction, options%decay_speed, options%decay_slip, &
      options%shear_strength, options%relaxation_time)
    options%law_of = c_funloc(tells_law)
    options%laws = c_loc(laws)
    options%n_laws = 1
    options%user = c_loc(host)
    contact = rubbing(options)
    call check(host%wanted > 11, 'law_of counts faces from 1')
    call expect(abut_ok, abut_friction(contact, of_faces, c_sizeof(of_faces(1)), two, n, error), 'friction of another law')
    call check(n == 2 .and. all(abs(of_faces%limit - 0.25d0*of_faces%normal_force) < 1d-15), 'its coefficient')
    call abut_destroy(contact)

    options%law_of = c_null_funptr
    options%laws = c_null_ptr
    options%n_laws = 0
    options%own_coefficient = c_funloc(tells_coefficient)
    contact = rubbing(options)
    call expect(abut_ok, abut_friction(contact, of_faces, c_sizeof(of_faces(1)), two, n, error), 'friction of an own law')
    call check(n == 2 .and. all(abs(of_faces%limit - 0.375d0*of_faces%normal_force) < 1d-15), 'its own coefficient')
    call check(host%told > 0, 'it is told speed, slip and pressure')
    call abut_destroy(contact)
  end subroutine

  ! The upper body's lower face erodes.
  subroutine surface_is_replaced()
    integer(c_int32_t), target :: fewer(2, n_faces - 1), of_body(n_faces - 1)
    integer(c_int32_t) :: old(n_faces - 1)
    real(c_double), target :: x(2, n_nodes), depths(n_faces - 1)
    type(abut_faces) :: faces
    type(c_ptr) :: contact
    contact = begun()
    x = lowered(0.15d0)
    call expect(abut_ok, step(contact, rest, x), 'a step before the erosion')
    call check(result%active_pairs == 1, 'a pair before the erosion')
    old = [1, 2, 3, 4, 6, 7, 8]
    fewer = corners(:, old)
    of_body = body(old)
    depths = 0.1d0
    faces = abut_faces_of(fewer, of_body, depths, stiffness)
    call expect(abut_ok, abut_replace_surface(contact, abut_points(rest), faces, old, error), 'replace_surface')
    call expect(abut_ok, step(contact, x, x), 'a step after the erosion')
    call check(result%active_pairs == 0, 'no pair after the erosion')
    old(1) = old(2)
    call expect(abut_bad_input, abut_replace_surface(contact, abut_points(rest), faces, old, error), 'an old face twice')
    call abut_destroy(contact)
  end subroutine

  subroutine callbacks_are_called()
    integer(c_int32_t), target :: inward(2, n_faces)
    real(c_double), target :: x(2, n_nodes)
    type(abut_options), target :: options
    type(host_type), target :: host
    type(abut_faces) :: faces
    type(c_ptr) :: contact
    host = fresh_host()
    call abut_options_init(options)
    call check(options%struct_size == c_sizeof(options) .and. options%events == 1, 'defaults')
    call check(options%facing_none == -0.2d0, 'default of the last double of the options')
    options%wanted = c_funloc(never)
    options%cancel = c_funloc(cancels)
    options%user = c_loc(host)
    contact = made(c_loc(options))
    x = lowered(0.15d0)
    call expect(abut_ok, step(contact, rest, x), 'a step of which no pair is wanted')
    call check(host%wanted > 0 .and. result%active_pairs == 0, 'wanted leaves out all pairs')
    call expect(abut_cancelled, step(contact, rest, x), 'a step that is cancelled')
    call check(index(abut_message(error), 'cancelled') > 0, 'and says so')
    call abut_destroy(contact)

    host = fresh_host()
    call abut_options_init(options)
    options%log = c_funloc(listens)
    options%user = c_loc(host)
    contact = made(c_loc(options))
    call expect(abut_ok, step(contact, rest, rest), 'a step at rest')
    call check(host%told == 0, 'nothing to tell')
    x = lowered(0.19d0)  ! 0.09 of D = 0.2: above the warning of 0.3
    call expect(abut_ok, step(contact, rest, x), 'a deep step')
    call check(host%told == 1 .and. index(host%text, 'pressed') > 0, 'log is told of compression')
    call abut_destroy(contact)

    inward = corners(2:1:-1, :)
    faces = abut_faces_of(inward, body, depth, stiffness)
    call expect(abut_ok, abut_create(2, abut_points(rest), faces, c_loc(options), contact, error), 'faces that look inwards')
    call check(host%told == 3 .and. index(host%text, 'body 2') > 0, 'log is told of them')
    call abut_destroy(contact)
  end subroutine

  subroutine what_is_wrong_is_refused_by_name()
    integer(c_int32_t), target :: from_0(2, n_faces)
    real(c_double), target :: x(2, n_nodes), force(2, n_nodes)
    type(abut_faces) :: faces
    type(abut_array) :: at_rest, fewer
    type(abut_report) :: report
    type(abut_pair) :: pairs(1)
    type(abut_error) :: of_another_version
    type(abut_options), target :: options
    type(c_ptr) :: contact
    integer(c_int64_t) :: n
    at_rest = abut_points(rest)
    call abut_options_init(options)
    options%max_pairs = -5
    call expect(abut_bad_input, abut_create(2, at_rest, squares(), c_loc(options), contact, error), 'max_pairs of -5')
    call check(index(abut_message(error), 'max_pairs is -5') > 0, 'its name')
    call expect(abut_bad_input, abut_create(4, at_rest, squares(), c_null_ptr, contact, error), 'dim of 4')
    call check(index(abut_message(error), 'dim is 4') > 0 .and. error%status == abut_bad_input, 'its text')
    faces = squares()
    faces%struct_size = 0
    call expect(abut_misuse, abut_create(2, at_rest, faces, c_null_ptr, contact, error), 'struct_size of 0')
    faces = squares()
    faces%index_base = 7
    call expect(abut_bad_input, abut_create(2, at_rest, faces, c_null_ptr, contact, error), 'index_base of 7')
    from_0 = corners - 1
    faces = abut_faces_of(from_0, body, depth, stiffness)
    call expect(abut_bad_input, abut_create(2, at_rest, faces, c_null_ptr, contact, error), 'node 0 counted from 1')
    call check(error%face_1 == 1, 'its face counts from 1')
    call check(.not. c_associated(contact), 'no handle of what was refused')

    call expect(abut_misuse, step(c_null_ptr, rest, rest), 'a step without handle')
    call expect(abut_misuse, abut_get_report(c_null_ptr, report, error), 'a report without handle')

    contact = made(c_null_ptr)
    call expect(abut_ok, abut_pairs(contact, pairs, c_sizeof(pairs(1)), one, n, error), 'pairs before the first step')
    call check(n == 0, 'there are none')
    call expect(abut_bad_input, abut_step(contact, 1d0, at_rest, at_rest, 7, abut_nothing(), result, error), 'take of 7')
    call expect(abut_bad_input, abut_step(contact, 0d0, at_rest, at_rest, abut_mean, abut_nothing(), result, error), 'dt of 0')
    call expect(abut_ok, step(contact, rest, rest), 'a step at rest')
    x = rest
    x(2, 6) = ieee_value(0d0, ieee_quiet_nan)
    force = 0
    call expect(abut_diverged, abut_step(contact, 1d0, at_rest, abut_points(x), abut_mean, abut_points(force), result, error), &
      'a position that is not finite')
    call check(error%face_1 >= 5, 'its face')
    x = lowered(0.8d0)
    call expect(abut_too_deep, abut_step(contact, 1d0, at_rest, abut_points(x), abut_mean, abut_points(force), result, error), &
      'faces too deep')
    call check(error%value > 2 .and. error%allowed == 2, 'how deep, and the limit')
    call check(all(force == 0), 'no forces of what was refused')
    fewer = at_rest
    fewer%count = 5
    call expect(abut_bad_input, abut_step(contact, 1d0, fewer, fewer, abut_mean, abut_nothing(), result, error), '5 nodes')
    fewer%count = -1
    call expect(abut_bad_input, abut_step(contact, 1d0, fewer, fewer, abut_mean, abut_nothing(), result, error), '-1 nodes')
    result%struct_size = 0
    call expect(abut_misuse, step(contact, rest, rest), 'a result with struct_size of 0')
    result = abut_step_result()
    of_another_version%struct_size = 8
    call expect(abut_misuse, abut_step(contact, 1d0, at_rest, at_rest, abut_mean, abut_nothing(), result, of_another_version), &
      'an error of another version')
    call check(of_another_version%status == abut_ok, 'it is not written to')
    call expect(abut_ok, step(contact, rest, rest), 'and goes on')
    call abut_destroy(contact)
    call abut_destroy(c_null_ptr)
  end subroutine

  subroutine overlaps_alone()
    type(abut_overlap) :: found(1)
    type(abut_array) :: x
    integer(c_size_t) :: entry_size
    integer(c_int64_t) :: n
    x = abut_points(rest)
    entry_size = c_sizeof(found(1))
    call expect(abut_ok, abut_find_overlaps(2, x, squares(), 0.05d0, found, entry_size, one, n, error), 'within 0.05')
    call check(n == 0, 'no overlap within 0.05')
    call expect(abut_ok, abut_find_overlaps(2, x, squares(), 0.2d0, found, entry_size, one, n, error), 'within 0.2')
    call check(n == 1 .and. found(1)%face_1 == 3 .and. found(1)%face_2 == 5, 'one overlap within 0.2')
    call check(abs(found(1)%area - 0.8d0) < 1d-15 .and. abs(found(1)%gap - 0.1d0) < 1d-15, 'its area and gap')
    call expect(abut_bad_input, abut_find_overlaps(5, x, squares(), 0.2d0, found, entry_size, one, n, error), 'dim of 5')
  end subroutine

  subroutine a_surface_is_found_of_cells()
    integer(c_int32_t), target :: nodes(3, 2), body(2)
    integer(c_int32_t), pointer :: of_faces(:), cell(:)
    real(c_double), pointer :: depths(:)
    real(c_double), target :: x(2, 4)
    type(c_ptr) :: surface, behind
    type(abut_faces) :: faces
    x = reshape([0d0, 0d0, 1d0, 0d0, 1d0, 1d0, 0d0, 1d0], [2, 4])
    nodes = reshape([1, 2, 3, 1, 4, 3], [3, 2])
    body = 2
    call expect(abut_ok, abut_surface_of(2, abut_points(x), abut_cells_of(nodes, body), surface, error), 'surface_of')
    faces = squares()
    call expect(abut_ok, abut_surface_faces(surface, faces, behind, error), 'surface_faces')
    call check(faces%n_faces == 4 .and. faces%n_nodes == 8 .and. faces%index_base == 1, 'four faces')
    call c_f_pointer(faces%nodes, of_faces, [8])
    call c_f_pointer(faces%depth, depths, [4])
    call c_f_pointer(behind, cell, [4])
    call check(all(of_faces == [1, 2, 2, 3, 4, 1, 3, 4]) .and. all(cell == [1, 1, 2, 2]), 'their nodes and cells')
    call check(all(abs(depths - 0.5d0) < 1d-15), 'their depths')
    call abut_surface_destroy(surface)
    call expect(abut_bad_input, abut_surface_of(4, abut_points(x), abut_cells_of(nodes), surface, error), 'dim of 4')
  end subroutine

  subroutine small_things()
    real(c_double), parameter :: mass(n_nodes) = 1
    real(c_double) :: k
    type(abut_stable) :: stable
    type(c_ptr) :: contact
    call expect(abut_ok, abut_skin_stiffness(6d0, [1d0, 2d0], two, k, error), 'skin_stiffness')
    call check(abs(k - 4) < 1d-15, 'k of a skin')
    call expect(abut_bad_input, abut_skin_stiffness(-1d0, [1d0, 2d0], two, k, error), 'a negative modulus')
    contact = made(c_null_ptr)
    call expect(abut_ok, abut_stable_step(contact, mass, int(n_nodes, c_int64_t), 1d0, stable, error), 'stable_step')
    ! omega^2 = 1 + twice 2 times the share of two faces, 1/2 each, over 1 kg
    call check(abs(stable%omega - sqrt(5d0)) < 1d-14 .and. abs(stable%dt - 1.7d0/sqrt(5d0)) < 1d-14, 'its figures')
    call check(stable%node >= 1 .and. stable%reason(1) /= c_null_char, 'its node and reason')
    call abut_destroy(contact)
    call expect(abut_ok, abut_limit_threads(1, error), 'one thread')
    call expect(abut_ok, abut_limit_threads(0, error), 'all threads')
    call expect(abut_bad_input, abut_limit_threads(-1, error), 'fewer threads than none')
  end subroutine
end program
