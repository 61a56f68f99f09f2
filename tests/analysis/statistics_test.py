#!/usr/bin/env python3
"""The statistics beside those of SciPy and R (packages survival and diptest), on 200 random data sets
each: normal and skewed ones, with ties, of two kinds, and ratios of whole numbers.

    tests/analysis/statistics_test.py build/ci/bin/statistics_answers
"""

import itertools
import math
import subprocess
import sys
import unittest

import numpy as np
from scipy import integrate, optimize, special, stats

SETS = 200
ALTERNATIVES = ["two-sided", "greater", "less"]
R = """
suppressMessages({library(survival); library(diptest)})
line <- readLines("stdin"); set.seed(1)
numbers <- function(text) as.numeric(strsplit(text, " ")[[1]])
show <- function(x) cat(sprintf("%.17g", x), "\\n")
events <- function(x) Surv(abs(x), x > 0)
for (each in strsplit(line, "\\t")) {
  x <- lapply(each[-(1:2)], numbers); argument <- suppressWarnings(as.numeric(each[2]))
  show(switch(each[1],
    holm = p.adjust(x[[1]], "holm"),
    power = power.t.test(x[[1]][1], x[[1]][2], 1, argument, type = "paired", strict = TRUE)$power,
    kaplan_meier = { s <- summary(survfit(events(x[[1]]) ~ 1));
                     rbind(s$time, s$surv, s$std.err^2) },
    restricted_mean = { t <- summary(survfit(events(x[[1]]) ~ 1), rmean = argument)$table;
                        c(t[["rmean"]], t[["se(rmean)"]]^2) },
    log_rank = { g <- rep(seq_along(x), lengths(x)); s <- survdiff(events(unlist(x)) ~ g);
                 d <- sum(s$exp > 0) - 1; c(s$chisq, d, pchisq(s$chisq, d, lower.tail = FALSE)) },
    dip = dip(x[[1]]),
    dip_p_value = dip.test(x[[1]])$p.value))
}
"""
random = np.random.default_rng(1945)


def sample(k, n):
    """The k-th kind of data, n values."""
    return [lambda: random.normal(0.4, 1.0, n), lambda: random.exponential(1.0, n) - 0.5,
            lambda: np.round(random.normal(0.4, 1.5, n)), lambda: random.integers(-5, 8, n) / 7,
            lambda: np.where(random.random(n) < 0.8, 42.0, 121.0) + random.normal(0, 2, n),
            lambda: 1e6 + random.normal(1, 1, n)][k % 6]()


def samples(least, most, ties=True):
    for k in range(SETS):
        while True:
            values = sample(k, int(random.integers(least, most + 1)))
            if len(set(values)) > 1 and (ties or len(set(values)) == len(values)):
                break
            if not ties:
                k += 1
        yield values


def scattered(values):
    return np.std(values) > 1e-9


def event_times():
    """Up to four groups; the end of a watch is negative. Half of them have ties."""
    for k in range(SETS):
        groups = []
        for _ in range(int(random.integers(2, 5))):
            n = int(random.integers(2, 30))
            time = random.exponential(random.uniform(0.5, 2.0), n) + 0.01
            watch = np.minimum(random.exponential(3.0, n) + 0.01 if k % 3 else np.full(n, 2.0), 2.5)
            if k % 2:
                time, watch = np.ceil(4 * time) / 4, np.ceil(4 * watch) / 4
            groups.append(np.where(time <= watch, time, -watch))
        if any((group > 0).any() for group in groups):
            yield groups


def t_beyond(tail, degrees):
    """SciPy 1.10 itself is too rough: 12.7062047364 where tan(0.475 pi) is 12.7062047362."""
    guess = stats.t.isf(tail, degrees)
    return optimize.brentq(lambda t: stats.t.sf(t, degrees) / tail - 1.0, 0.99 * guess,
                           1.01 * guess, xtol=1e-14 * guess, rtol=1e-15)


def two_sided_power(n, effect, alpha):
    """Over the estimated standard deviation, by another quadrature than ours."""
    shift, degrees = effect * np.sqrt(n), n - 1
    beyond = t_beyond(alpha / 2, degrees)

    def integrand(sd):
        density = np.sqrt(degrees) * stats.chi.pdf(np.sqrt(degrees) * sd, degrees)
        return density * (stats.norm.sf(beyond * sd - shift) + stats.norm.cdf(-beyond * sd - shift))

    width = 12.0 / np.sqrt(2 * degrees)
    return integrate.quad(integrand, max(0.0, 1.0 - width), 1.0 + width, epsabs=0.0, epsrel=1e-12,
                          limit=500)[0]


def patterns(terms, alternative):
    """p of all patterns of signs: SciPy's exact Wilcoxon test knows no ties."""
    signs = np.array(list(itertools.product((-1, 1), repeat=len(terms))))
    sums, seen = signs @ np.abs(terms), np.sum(terms)
    tie = 1e-9 * np.sum(np.abs(terms))
    beyond = {"greater": sums >= seen - tie, "less": sums <= seen + tie,
              "two-sided": np.abs(sums) >= abs(seen) - tie}[alternative]
    return np.mean(beyond)


def signed_ranks(values):
    """Ranks of what is not 0; equal to ten digits is equal."""
    scale = np.max(np.abs(values))
    kept = np.round(values / scale, 10)
    kept = kept[kept != 0]
    return np.sign(kept) * stats.rankdata(np.abs(kept))


def best_split(values):
    x = np.sort(values)
    squares = lambda some: np.sum((some - np.mean(some)) ** 2)
    k = min(range(1, len(x)), key=lambda k: squares(x[:k]) + squares(x[k:]))
    within = squares(x[:k]) + squares(x[k:])
    return [k, np.mean(x[:k]), np.mean(x[k:]), 1 - within / squares(x)]


class Statistics(unittest.TestCase):
    def setUp(self):
        self.asked, self.expected = [], []

    def ask(self, quantity, argument, data, expected=None):
        data = data if isinstance(data, list) else [data]
        texts = [" ".join(repr(float(x)) for x in values) for values in data]
        self.asked.append("\t".join([quantity, str(argument), *texts]))
        if expected is not None:
            self.expected.append(np.atleast_1d(expected).astype(float))

    @staticmethod
    def answers(command, lines):
        done = subprocess.run(command, input="\n".join(lines) + "\n", text=True, check=True,
                              capture_output=True)
        return [np.array([float(x) for x in line.split()]) if line != "none" else None
                for line in done.stdout.splitlines()]

    def compare(self, relative=1e-9, absolute=1e-12, of_r=False):
        """Every answer with what is expected, or with what R says."""
        if of_r:
            self.expected = self.answers(["Rscript", "--vanilla", "-e", R], self.asked)
        ours = self.answers([PROGRAM], self.asked)
        self.assertGreaterEqual(len(ours), SETS // 2)
        self.assertEqual(len(ours), len(self.expected))
        for question, own, other in zip(self.asked, ours, self.expected):
            self.assertIsNotNone(own, question)
            self.assertEqual(len(own), len(other), question)
            np.testing.assert_allclose(own, other, relative, absolute, err_msg=question)

    def test_quantiles_and_standard_deviations(self):
        for values in samples(2, 40):
            p = random.random()
            self.ask("quantile", p, values, np.quantile(values, p))
            self.ask("sd", "", values, np.std(values, ddof=1))
        self.compare()

    def test_intervals_and_tests_of_student(self):
        for k, values in enumerate(samples(3, 40)):
            level = random.choice([0.5, 0.9, 0.95, 0.999])
            half = stats.sem(values) * t_beyond((1 - level) / 2, len(values) - 1)
            self.ask("t_interval", level, values, np.mean(values) + np.array([-half, half]))
            which = ALTERNATIVES[k % 3]
            test = stats.ttest_1samp(values, 0.0, alternative=which)
            self.ask("paired_t", which, values, [test.statistic, test.pvalue])
            margin = abs(np.mean(values)) * random.uniform(0.5, 2) + 0.1
            above = stats.ttest_1samp(values, -margin, alternative="greater").pvalue
            below = stats.ttest_1samp(values, margin, alternative="less").pvalue
            self.ask("equivalence", margin, values, max(above, below))
        self.compare(1e-8, 1e-15)

    def test_exact_tests_with_ties(self):
        for k, values in enumerate(samples(2, 10)):
            which = ALTERNATIVES[k % 3]
            self.ask("sign_flip", which, values, [np.mean(values), patterns(values, which)])
            ranks = signed_ranks(values)
            self.ask("signed_rank", which, values, [ranks[ranks > 0].sum(), patterns(ranks, which)])
            self.ask("rank_biserial", "", values, ranks.sum() / np.abs(ranks).sum())
        self.compare()

    def test_exact_and_approximate_wilcoxon_tests(self):
        for k in range(SETS):
            which = ALTERNATIVES[k % 3]
            n = int(random.integers(10, 90) if k % 2 else random.integers(101, 160))
            values = random.normal(0.2, 1.0, n)
            method = {"mode": "exact"} if k % 2 else {"mode": "approx", "correction": True}
            ranks = signed_ranks(values)
            test = stats.wilcoxon(values, alternative=which, **method)
            self.ask("signed_rank", which, values, [ranks[ranks > 0].sum(), test.pvalue])
        self.compare()

    def test_effect_sizes(self):
        for values in samples(3, 40):
            half = (len(values) - 1) / 2
            factor = np.exp(special.gammaln(half) - special.gammaln(half - 0.5)) / np.sqrt(half)
            self.ask("hedges_g_z", "", values,
                     factor * np.mean(values) / np.std(values, ddof=1))
        self.compare(1e-8)

    def test_bootstrap_intervals(self):
        # Data without lumps: else the ends lie in gaps, and depend on single resamples.
        for k in range(SETS):
            n = int(random.integers(12, 41))
            values = random.normal(0.4, 1.0, n) if k % 2 else random.exponential(1.0, n)
            ends = stats.bootstrap((values,), np.mean, confidence_level=0.9, method="BCa",
                                   batch=10000, n_resamples=10000,
                                   random_state=random).confidence_interval
            self.ask("bca_interval", 0.9, values, [ends.low, ends.high])
        # Each end of 10,000 resamples is uncertain by 4 % of a standard error (intervals.hpp), of
        # skewed data by more.
        for question, own, other in zip(self.asked, self.answers([PROGRAM], self.asked),
                                        self.expected):
            values = [float(x) for x in question.split("\t")[2].split()]
            np.testing.assert_allclose(own, other, 0, 0.2 * stats.sem(values), err_msg=question)

    def test_power(self):
        for _ in range(SETS):
            n = int(np.exp(random.uniform(np.log(2), np.log(300))))
            effect, alpha = random.uniform(-4, 4) / np.sqrt(n), random.choice([0.05, 0.01, 0.001])
            self.ask("power", alpha, np.array([n, effect]), two_sided_power(n, effect, alpha))
        self.compare(1e-9)
        self.compare(1e-6, 1e-9, of_r=True)

    def test_holm(self):
        for k in range(SETS):
            p = random.random(int(random.integers(1, 60))) ** 3
            self.ask("holm", "", np.round(p, 2) if k % 2 else p)
        self.compare(of_r=True)

    def test_survival(self):
        for groups in event_times():
            self.ask("log_rank", "", groups)
            self.ask("kaplan_meier", "", groups[0] if (groups[0] > 0).any() else [1.0])
            # As far as the first sample knows its survival, or less; R wants some time before.
            times = np.sort(np.abs(groups[0]))
            horizon = times[0] + (times[-1] - times[0]) * random.uniform(0.2, 1.0)
            self.ask("restricted_mean", horizon, groups[0])
        # The variance at a survival of 0 is 0 to us, and undefined to R.
        self.expected = [np.nan_to_num(each) for each in
                         self.answers(["Rscript", "--vanilla", "-e", R], self.asked)]
        self.compare(1e-7, 1e-9)

    def test_shapes(self):
        for values in samples(4, 60, ties=False):
            self.ask("dip", "", values)
        self.compare(of_r=True)
        self.setUp()
        for values in samples(4, 60):
            self.ask("two_groups", "", values, best_split(values))
            self.ask("skewness", "", values, stats.skew(values))
        self.compare(1e-6, 1e-9)

    def test_chances_of_shapes(self):
        for values in samples(6, 30, ties=False):
            self.ask("dip_p_value", "", values)
        expected = self.answers(["Rscript", "--vanilla", "-e", R], self.asked)
        for question, own, other in zip(self.asked, self.answers([PROGRAM], self.asked), expected):
            p = float(other[0])
            # Ours is a share of 2000; R interpolates a table.
            error = math.sqrt(max(p * (1 - p), 1e-3) / 2000)
            if p < 0.9:
                self.assertAlmostEqual(own[0], p, delta=4.5 * error + 0.005, msg=question)
            else:  # the least dip that there is, 1 / (2n), which many samples have
                self.assertGreater(own[0], 0.85, question)


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
