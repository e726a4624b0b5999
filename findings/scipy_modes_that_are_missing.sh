#!/bin/bash
# SciPy (ARPACK): lowest modes of a square membrane that is held or free, by eigsh around sigma = 0
# Packages of Debian 12: python3-scipy=1.10.1-2. Needs the python3 of Debian with numpy.
# Guess: tol is an error of the eigenvalues: with 1e-6 the lowest eight of a held membrane, some of which are double, are right to 1e-6.
#   A free body has a singular stiffness, which sigma = 0 either refuses or solves, as roundings let it through.
# Seen: with tol = 1e-6 three of the lowest eight are missing, and three higher ones stand in their place, each of them right to 1e-6. Only
#   one of two equal frequencies is found. Of the free membrane the elastic modes have residuals of more than 5 % of the lowest of them and
#   errors of 1e-5 and more, at tol = 0, in silence. With sigma = -0.01 they are right to 1e-10.
set -euo pipefail
work=$(mktemp -d) && trap 'rm -rf "$work"' EXIT && cd "$work"
apt-get -qq -y --no-install-recommends --download-only --reinstall -o APT::Sandbox::User=root -o Debug::NoLocking=1 -o Dir::Cache::archives="$work" \
    install python3-scipy=1.10.1-2
for deb in *.deb; do dpkg -x "$deb" .; done
export PYTHONPATH="$work/usr/lib/python3/dist-packages"

/usr/bin/python3 - <<'P' | tee output
import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import eigsh

n = 20

def membrane(is_free):  # springs between the points of a square grid, to the frame as well unless it is free
    row = sparse.diags([-1, 2, -1], [-1, 0, 1], shape=(n, n)).tolil()
    if is_free:
        row[0, 0] = row[n - 1, n - 1] = 1
    one = sparse.identity(n)
    return (sparse.kron(row, one) + sparse.kron(one, row)).tocsc()

def starts():  # the vector that a search begins with
    return [np.random.default_rng(seed).normal(size=n * n) for seed in range(4)]

held, free = membrane(False), membrane(True)
right, right_free = np.linalg.eigvalsh(held.toarray()), np.linalg.eigvalsh(free.toarray())
for tol in 0, 1e-6:
    missing, error = [], []
    for start in starts():
        found = np.sort(eigsh(held, k=8, sigma=0, tol=tol, v0=start, return_eigenvectors=False))
        missing.append(int(np.sum(right < found[-1] * (1 + 1e-5))) - 8)
        error.append(max(np.min(abs(right / value - 1)) for value in found))
    print(f"held, tol {tol}: modes missing below the highest found {missing}, each found is right to 1e-6: {max(error) < 1e-6}")
for sigma in 0, -0.01:
    error, residual = [], []
    for start in starts():
        values, modes = eigsh(free, k=5, sigma=sigma, v0=start)
        error.append(np.max(abs(np.sort(values)[1:] / right_free[1:5] - 1)))
        residual.append(np.max(np.linalg.norm(free @ modes - modes * values, axis=0)) / right_free[1])
    print(f"free, sigma {sigma}: elastic values right to 1e-5: {max(error) < 1e-5}, to 1e-10: {max(error) < 1e-10}; "
          f"residuals above 5 % of the lowest each time: {min(residual) > 0.05}")
P
diff output - <<'P'
held, tol 0: modes missing below the highest found [0, 0, 0, 0], each found is right to 1e-6: True
held, tol 1e-06: modes missing below the highest found [3, 3, 3, 3], each found is right to 1e-6: True
free, sigma 0: elastic values right to 1e-5: False, to 1e-10: False; residuals above 5 % of the lowest each time: True
free, sigma -0.01: elastic values right to 1e-5: True, to 1e-10: True; residuals above 5 % of the lowest each time: False
P
