"""shoal: formation planning of underwater vehicles as optimisation problems, to try and to measure.

    import shoal

    dataset, measures = shoal.run("redsea_square", {"behaviour.kind": "pairwise_referencing"}, seed=7)

Scenarios and studies are names of the library, files, or dicts; changes are dicts with the dotted
keys of `shoal run --set`. The same seed gives the same bits as the program. Numbers are SI (names say
where they are not), positions are metres east and north, angles counter-clockwise from east where they
are radians, of the compass where they are degrees in files.

Bad input raises InputError with the sentence that the program prints.
"""

from . import _arguments, _shoal
from ._shoal import (Command, InputError, OwnState, Ping, PingFilter, Plan, Planner, Problem, Solution, SystemError, Table,
                     Neighbourhood, Neighbourhoods, SolverProblem, StopSolving, World, formation_quality, match, posed,
                     program, register, solve)
from ._shoal import version as __version__
from ._catalogue import catalogue, measures, options
from ._members import behaviour, guidance, measure, selection, solver
from ._potentials import Potential, potential
from ._studies import claims, study_dataset, study_report, sweep, tables, trials, write_tables
from ._trials import Run, current, run, scenario


def load_plugin(file):
    """Makes the members of a plugin known, a shared library that says SHOAL_PLUGIN: to list, run, and
    sweep, as `shoal --plugin` does. SHOAL_PLUGINS in the environment names some for all processes.
    Raises InputError if it is none, or was built for another shoal.
    """
    _shoal.load_plugin(_arguments.path(file, "file"))


__all__ = ["Command", "InputError", "Neighbourhood", "Neighbourhoods", "OwnState", "Ping", "PingFilter", "Plan", "Planner",
           "Potential", "Problem", "Run", "Solution", "SolverProblem", "StopSolving", "SystemError", "Table", "World",
           "__version__", "behaviour", "catalogue", "claims", "current", "formation_quality", "guidance",
           "load_plugin", "match", "measure", "measures", "options", "posed", "potential", "program", "register",
           "run", "scenario", "selection", "solve", "solver", "study_dataset", "study_report", "sweep", "tables",
           "trials", "write_tables"]
