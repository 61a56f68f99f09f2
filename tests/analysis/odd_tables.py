"""A table of each form that `shoal tables` writes, for numbers of every kind."""

import itertools

from made_tables import steady

LEVELS = {"behaviour": ["rigid_registration", "assignment_registration", "pairwise_referencing"],
          "settings": ["text", "program"],
          "a_factor_with_a_long_name": [
              "a level whose name takes more than the half of a column to say",
              "averylongnamewithoutanyblankinwhichitcouldbebrokenintolines", "-"],
          "ping_period": ["5", "15", "30", "60", "120"],
          "delta_theta_deg_deg": ["2", "5", "10", "45", "90"],
          "weight": ["0.001", "0.1", "1", "100"],
          "group": ["construction", "redsea", "vortex", "channels"]}
FACTORS = {**{name: (levels, "") for name, levels in LEVELS.items()},
           "ping_period": (LEVELS["ping_period"], "period_s"),
           "delta_theta_deg": (LEVELS["delta_theta_deg_deg"], "delta_theta_deg")}
HEADINGS = ["energy mean (Wh)", "quality settled (m)"]


def request(of="table", **asked):
    return {"name": "odd", "of": of, "factors": FACTORS, **asked}


def crossed(*factors):
    return [dict(zip(factors, levels))
            for levels in itertools.product(*(LEVELS[factor] for factor in factors))]


def cells(rows, columns, asked):
    """Rows without numbers, of a request that names its measures; fill() gives them some."""
    measures = asked.get("measures") or asked["series"]
    names = ["_".join([*levels.values(), measure])
             for levels in crossed(*columns) for measure in measures]
    numbers = {name + end: "2" for name in names for end in ("", "_n")}
    return [{**row, **numbers} for row in rows], asked


def indices(rows, names):
    return [{**row, **{name: "" for name in names}} for row in rows], {"name": "odd", "measures": [
        "energy_mean_wh", "quality_settled_m"]}


def of_measures(rows):
    return [{"measure": heading, **row} for heading in HEADINGS for row in rows]


def forms():
    """name -> (rows, request)."""
    sampled = [{"factor": name} for name in ("ping_period", "bearing_noise", "drifting_radius")]
    changes = [{"factor": "own_weight", "from": "1", "to": "0.1"},
               {"factor": "planned", "from": "always", "to": "per ping"},
               {"factor": "all", "from": "", "to": ""}]
    measures = ["energy_mean_wh", "quality_settled_m"]
    return {
        "curves": cells(crossed("behaviour", "delta_theta_deg_deg"), ("settings",),
                        request(columns=["settings"], measures=measures)),
        "24 curves": cells(crossed("group", "behaviour", "settings"), ("ping_period",),
                           request(columns=["ping_period"], measures=measures[:1])),
        "curves of wide steps": cells(crossed("behaviour"), ("weight",),
                                      request(columns=["weight"], measures=measures[:1])),
        "series": cells([{"time_s": "0"}], ("behaviour", "settings"),
                        request(columns=["behaviour", "settings"], series=["quality"], every=300)),
        "rows": cells(crossed("group", "a_factor_with_a_long_name"), ("behaviour",),
                      request(columns=["behaviour"], measures=[*measures, "nees_per_state"],
                              statistic="mean [min, max]")),
        "one row": cells(crossed("settings")[:1], (), request(measures=measures)),
        "one trial": cells([{"time_s": "0"}], (), request(series=["quality"], every=1)),
        "differences of a number": (
            [{**row, "measure": m, "delta_theta_deg": step, "difference": "", "difference_n": "2"}
             for m in HEADINGS for row in crossed("group")
             for step in LEVELS["delta_theta_deg_deg"] if step != "10"],
            request("comparison", factor="delta_theta_deg", reference="10", measures=measures)),
        "differences of names": (
            [{**row, "measure": m, "behaviour": "rigid_registration", "difference": "",
              "difference_n": "2"} for m in HEADINGS for row in crossed("group", "settings")],
            request("comparison", factor="behaviour", reference="pairwise_referencing",
                    measures=measures)),
        "indices": indices(of_measures(sampled), ("first_order", "first_order_low",
                                                 "first_order_high", "total")),
        "effects": indices(of_measures(sampled), ("mu", "mu_star", "sigma")),
        "pairs": indices(of_measures([{"factor": a["factor"], "and_factor": b["factor"]} for a, b
                                     in itertools.combinations(sampled, 2)]), ("second_order",)),
        "convergence": indices(of_measures([{**row, "base_samples": str(2 ** k)} for row in sampled
                                           for k in range(3, 8)]), ("first_order", "total")),
        "changes": indices(of_measures(changes), ("share", "share_low", "share_high", "alone",
                                                 "last")),
    }


VALUES = {
    "steady": steady,
    "equal": lambda k: 5.0,
    "nothing": lambda k: 0.0,
    "huge": lambda k: 1e12 * steady(k),
    "tiny": lambda k: 1e-9 * steady(k),
    "nearly equal": lambda k: 1e6 + 1e-3 * steady(k),
    "below zero": lambda k: -1e4 * steady(k),
    "of both signs": lambda k: steady(k) - 10.0,
    "one far away": lambda k: 1e6 if k == 3 else steady(k),
    "with gaps": lambda k: None if k % 3 else steady(k),
    "one alone": lambda k: steady(k) if k in (0, 5) else None,
}
# To draw all forms with all numbers would take a minute: these stand for the others.
FOR_ALL = {"curves", "rows", "differences of names", "changes"}
OF_ALL = {"steady", "equal", "with gaps", "one alone"}
