#!/usr/bin/env python3
"""What SciPy and NumPy make of some samples, for tests/analysis/statistics_scipy_test.cpp.

    tests/data/statistics_scipy.py > tests/data/statistics_scipy.csv

Needs python3-scipy, which neither the build nor the tests do. The file was written with SciPy
1.10.1 and NumPy 1.24.2. An argument is a probability, a level, a margin, an alternative ... as the
quantity has it; a sample is written with all its digits, its values separated by blanks.
"""

import csv
import sys

import numpy as np
from scipy import integrate, optimize, stats

ALTERNATIVES = ["two-sided", "greater", "less"]
random = np.random.default_rng(1945)
writer = csv.writer(sys.stdout, lineterminator="\n")


def write(quantity, argument, sample, expected):
    writer.writerow([quantity, argument, " ".join(repr(float(x)) for x in sample),
                     repr(float(expected))])


def t_beyond(tail, degrees):
    """SciPy 1.10 itself is too rough: 12.7062047364 where tan(0.475 pi) is 12.7062047362."""
    guess = stats.t.isf(tail, degrees)
    return optimize.brentq(lambda t: stats.t.sf(t, degrees) / tail - 1.0, 0.99 * guess,
                           1.01 * guess, xtol=1e-14 * guess, rtol=1e-15)


def signed_rank_exact(sample, alternative):
    """SciPy's own exact distribution knows no ties: every pattern of signs is listed instead."""
    ranks = np.sign(sample) * stats.rankdata(np.abs(sample))
    return stats.permutation_test((ranks,), np.sum, permutation_type="samples", n_resamples=np.inf,
                                  alternative=alternative).pvalue


def two_sided_power(n, effect, alpha):
    """Over the estimated standard deviation: SciPy's noncentral t is Boost's, as is ours."""
    shift, degrees = effect * np.sqrt(n), n - 1
    beyond = t_beyond(alpha / 2, degrees)

    def integrand(sd):
        density = np.sqrt(degrees) * stats.chi.pdf(np.sqrt(degrees) * sd, degrees)
        return density * (stats.norm.sf(beyond * sd - shift) + stats.norm.cdf(-beyond * sd - shift))

    width = 12.0 / np.sqrt(2 * degrees)
    return integrate.quad(integrand, max(0.0, 1.0 - width), 1.0 + width, epsabs=0.0, epsrel=1e-13,
                          limit=500)[0]


def samples_of_sizes(*sizes):
    return [random.normal(0.4, 1.0, n) for n in sizes]


writer.writerow(["quantity", "argument", "sample", "expected"])
for sample in samples_of_sizes(1, 2, 7, 20):
    for p in [0.0, 0.1, 0.25, 0.5, 2.0 / 3.0, 0.999, 1.0]:
        write("quantile", p, sample, np.quantile(sample, p))

for sample in samples_of_sizes(2, 5, 30):
    write("sd", "", sample, np.std(sample, ddof=1))
    for level in [0.5, 0.95, 0.999]:
        half = stats.sem(sample) * t_beyond((1 - level) / 2, len(sample) - 1)
        write("t_low", level, sample, np.mean(sample) - half)
        write("t_high", level, sample, np.mean(sample) + half)
    for alternative in ALTERNATIVES:
        test = stats.ttest_rel(sample, np.zeros(len(sample)), alternative=alternative)
        write("paired_t", alternative, sample, test.pvalue)
    for margin in [0.3, 1.5]:
        above = stats.ttest_1samp(sample, -margin, alternative="greater").pvalue
        below = stats.ttest_1samp(sample, margin, alternative="less").pvalue
        write("equivalence", margin, sample, max(above, below))

for alternative in ALTERNATIVES:
    for sample in samples_of_sizes(1, 6, 25, 50):
        test = stats.wilcoxon(sample, alternative=alternative, mode="exact")
        write("signed_rank", alternative, sample, test.pvalue)
    for sample in [np.round(2 * x) for x in samples_of_sizes(8, 12)]:  # ties
        nonzero = sample[sample != 0]
        write("signed_rank", alternative, nonzero, signed_rank_exact(nonzero, alternative))
    for sample in [*samples_of_sizes(130), np.round(2 * samples_of_sizes(150)[0] - 0.5)]:
        test = stats.wilcoxon(sample, alternative=alternative, mode="approx", correction=True,
                              zero_method="wilcox")
        write("signed_rank", alternative, sample, test.pvalue)
    for sample in [*samples_of_sizes(2, 5, 13), np.round(samples_of_sizes(12)[0], 1)]:
        test = stats.permutation_test((sample,), np.mean, permutation_type="samples",
                                      n_resamples=np.inf, alternative=alternative)
        write("sign_flip", alternative, sample, test.pvalue)

for n, effect, alpha in [(2, 1.0, 0.05), (5, 2.0, 0.01), (20, 0.5, 0.05), (20, -0.5, 0.05),
                         (20, 0.0, 0.05), (100, 0.3, 0.1), (1000, 0.1, 0.001), (10000, 0.03, 0.05)]:
    write("power", alpha, [n, effect], two_sided_power(n, effect, alpha))

for sample in samples_of_sizes(12, 40):
    ends = stats.bootstrap((sample,), np.mean, confidence_level=0.9, method="BCa", batch=10000,
                           n_resamples=400000, random_state=random).confidence_interval
    write("bca_low", 0.9, sample, ends.low)
    write("bca_high", 0.9, sample, ends.high)
