#!/bin/bash
# GNU Fortran: three numbers per row read as read(line, *), as tables of materials and nodes are read by programs of our field
# Packages of Debian 12: libgfortran5=12.2.0-14+deb12u1. Needs gfortran 12.
# Guess: a row that does not hold three plain numbers is an error, which iostat tells: a quotient, a product, a decimal comma, an empty
#   column, a sign without the e.
# Seen: iostat is 0 for all of these. A quotient ends its row: the numbers from there on keep what they held (-1 here), as an empty column
#   does. 2*100 is 100 twice. 7,85 is 7 and 85 and pushes the others along, and 7-3 is 0.007. A fourth number is passed over. Only text and a
#   row that is too short are errors.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install libgfortran5=12.2.0-14+deb12u1
for deb in *.deb; do dpkg -x "$deb" .; done
LD_LIBRARY_PATH="$work/usr/lib/x86_64-linux-gnu"
export LD_LIBRARY_PATH

cat > rows <<'T'
7850 200 0.3
7850 200/2 0.3
2*100 0.3
7,85 200 0.3
7850,,0.3
7-3 200 0.3
7850 200 0.3 9
7850 200;0.3 9
7850 200 steel
7850 200
T
cat > a.f90 <<'F'
program rows
    implicit none
    character(40) :: line
    real(8) :: x(3)
    integer :: ended, status
    do
        read(*, '(a)', iostat=ended) line
        if (ended /= 0) exit
        x = -1
        read(line, *, iostat=status) x
        if (status == 0) then
            print '(a16, 3g12.4)', line, x
        else
            print '(a16, a)', line, "     error"
        end if
    end do
end program
F
gfortran a.f90 -o a
./a < rows | sed "s/ *$//" | tee output
diff output - <<'T'
7850 200 0.3       7850.       200.0      0.3000
7850 200/2 0.3     7850.       200.0      -1.000
2*100 0.3          100.0       100.0      0.3000
7,85 200 0.3       7.000       85.00       200.0
7850,,0.3          7850.      -1.000      0.3000
7-3 200 0.3       0.7000E-02   200.0      0.3000
7850 200 0.3 9     7850.       200.0      0.3000
7850 200;0.3 9     7850.       200.0      0.3000
7850 200 steel       error
7850 200             error
T
