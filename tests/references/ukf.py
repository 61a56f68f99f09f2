"""tests/data/ukf.csv: the filter with sigma points.

Barisic, Vukic and Miskovic (2011), Table 2, with the corrections C47-C51 of
notebooks/corrections.md. A row is one entry of a matrix or vector: case, quantity, row, col, value.

Cases W_...: weights of L states with alpha, beta, kappa. In double precision they lose digits where
alpha is small, and their sums more; what is stored is what numpy makes of them.
Case C1: a vehicle (x, y, v, psi in m, m, m/s, rad) with range and bearing to a beacon and its speed
measured, in steps of 0.5 s, of which some give no measurement (nan). Given: x0, P0, Rv, Rn, abk =
(alpha, beta, kappa), and y of each step; computed: what the filter has in each step. `innov` is 0
where nothing was measured.
Case C2: a linear system x' = F x, y = H x, by the equations of Kalman's own filter.
"""

import numpy

from reference import Reference

GIVEN = {"L", "alpha", "beta", "kappa", "x0", "P0", "Rv", "Rn", "abk", "y", "F", "H"}


def weights(L, alpha, beta, kappa):
    """Steps 0.5-0.7, and gamma (C47)."""
    lam = alpha**2 * (L + kappa) - L
    other = 0.5 / (L + lam)
    mean = numpy.array([lam / (L + lam)] + 2 * L * [other])
    covariance = mean.copy()
    covariance[0] += 1.0 - alpha**2 + beta
    return lam, numpy.sqrt(L + lam), mean, covariance


def drawn(x, P, gamma):
    """Sigma points, as columns: the mean, then on either side of it."""
    S = gamma * numpy.linalg.cholesky(P)
    return numpy.hstack([x, x + S, x - S])


def spread(weight, a, b):
    return (weight * a) @ b.T


def vehicle(X):
    T = 0.5
    x, y, v, psi = X
    return numpy.array([x + T * v * numpy.cos(psi), y + T * v * numpy.sin(psi),
                        v + T * (0.1 - 0.05 * v * abs(v)), psi + T * 0.08 * v])


def measured(X):
    dx, dy = X[0] - 20.0, X[1] + 5.0
    return numpy.array([numpy.hypot(dx, dy), numpy.arctan2(dy, dx), X[2]])


def filter_step(x, P, y, Rv, Rn, abk):
    """Step 2 of Table 2."""
    _, gamma, wm, wc = weights(len(x), *abk)
    sigma = drawn(x, P, gamma)
    moved = vehicle(sigma)
    x = moved @ wm[:, None]
    P = spread(wc, moved - x, moved - x) + Rv  # C48
    redrawn = drawn(x, P, gamma)  # C49
    Y = measured(redrawn)
    y_pred = Y @ wm[:, None]
    P_y = spread(wc, Y - y_pred, Y - y_pred) + Rn  # C50
    P_xy = spread(wc, redrawn - x, Y - y_pred)
    seen = ~numpy.isnan(y[:, 0])  # C51
    innovation = numpy.where(seen[:, None], y - y_pred, 0.0)
    P_seen = P_y[numpy.ix_(seen, seen)]
    K = P_xy[:, seen] @ numpy.linalg.inv(P_seen)
    x_post, P_post = x + K @ innovation[seen], P - K @ P_seen @ K.T
    return {"sigma": sigma, "sigma_prop": moved, "x_pred": x, "P_pred": P, "sigma_redraw": redrawn,
            "Y": Y, "y_pred": y_pred, "P_y": P_y, "P_xy": P_xy, "K": K, "innov": innovation,
            "x_post": x_post, "P_post": P_post}


def kalman_step(x, P, y, F, H, Rv, Rn):
    x, P = F @ x, F @ P @ F.T + Rv
    K = P @ H.T @ numpy.linalg.inv(H @ P @ H.T + Rn)
    return {"x_post_exactKF": x + K @ (y - H @ x),
            "P_post_exactKF": P - K @ H @ P}


def weights_case(given):
    L, *abk = (given[name].item() for name in ("L", "alpha", "beta", "kappa"))
    lam, gamma, mean, covariance = weights(int(L), *abk)
    values = {"lambda": lam, "gamma": gamma, "wm0": mean[0], "wc0": covariance[0], "wi": mean[1],
              "sum_wm": mean.sum(), "sum_wc": covariance.sum()}
    return {name: numpy.array([[value]]) for name, value in values.items()}


def matrices(rows):
    """{case: {quantity: matrix}}"""
    entries = {}
    for row in rows:
        place = int(row["row"]), int(row["col"])
        entries.setdefault(row["case"], {}).setdefault(row["quantity"], {})[place] = row["value"]
    found = {}
    for case, quantities in entries.items():
        for quantity, values in quantities.items():
            matrix = numpy.empty(numpy.add(max(values), 1))
            for place, value in values.items():
                matrix[place] = float(value)
            found.setdefault(case, {})[quantity] = matrix
    return found


def computed(given):
    """{case: {quantity: matrix}} of all that is not given."""
    found = {case: weights_case(of) for case, of in given.items() if case.startswith("W_")}
    one, two = given["C1"], given["C2"]
    x, P = one["x0"], one["P0"]
    for case in (f"C1_step{k}" for k in range(1, 7)):
        found[case] = filter_step(x, P, given[case]["y"], one["Rv"], one["Rn"], one["abk"][0])
        x, P = found[case]["x_post"], found[case]["P_post"]
    x, P = two["x0"], two["P0"]
    for case in (f"C2_step{k}" for k in range(1, 4)):
        found[case] = kalman_step(x, P, given[case]["y"], two["F"], two["H"], two["Rv"], two["Rn"])
        x, P = found[case]["x_post_exactKF"], found[case]["P_post_exactKF"]
    return found


def results(rows):
    found = computed(matrices(row for row in rows if row["quantity"] in GIVEN))
    for row in rows:
        if row["quantity"] in GIVEN:
            yield {}
        else:
            matrix = found[row["case"]][row["quantity"]]
            yield {"value": matrix[int(row["row"]), int(row["col"])]}


REFERENCES = [Reference("ukf.csv", results, digits=17, tolerance=1e-13)]
