"""Means of what is uncertain, with confidence intervals; samples, and several runs of one thing."""

import math

import numpy as np

CONFIDENCE = 0.95


def student_t(freedom, confidence=CONFIDENCE):
    """The size that Student's t does not exceed with this confidence. Where t = sqrt(n) tan(angle),
    the density in the angle is the power n - 1 of its cosine."""
    angle = np.linspace(0, math.pi / 2, 4001)
    density = np.cos(angle)**(freedom - 1)
    share = np.concatenate([[0], np.cumsum(density[1:] + density[:-1])])
    return math.sqrt(freedom) * math.tan(np.interp(confidence, share / share[-1], angle))


def interval(values):
    """Mean, and half of its confidence interval; NaN of less than two values."""
    count = len(values)
    if count == 0:
        return math.nan, math.nan
    half = (student_t(count - 1) * float(np.std(values, ddof=1)) / math.sqrt(count)
            if count > 1 else math.nan)
    return float(np.mean(values)), half


def difference(first, second):
    """How much the mean grows from the first values to the second, and half of its confidence
    interval: Welch's, for spreads that differ. NaN where one of them has less than two values."""
    if not len(first) or not len(second):
        return math.nan, math.nan
    change = float(np.mean(second) - np.mean(first))
    if min(len(first), len(second)) < 2:
        return change, math.nan
    squares = [float(np.var(values, ddof=1)) / len(values) for values in (first, second)]
    if sum(squares) == 0:
        return change, 0.0
    freedom = sum(squares)**2 / sum(square**2 / (len(values) - 1)
                                    for square, values in zip(squares, (first, second)))
    return change, student_t(freedom) * math.sqrt(sum(squares))


def describe(values):
    """Mean, spread (standard deviation), limits of 5 and 95 % and the largest of samples."""
    low, high = np.percentile(values, [5, 95])
    return {"mean": float(np.mean(values)), "spread": float(np.std(values)), "low": float(low),
            "high": float(high), "most": float(np.max(values))}


def number(value, digits=4):
    """Empty where it is none."""
    return "" if math.isnan(value) else f"{value:.{digits}g}"


def with_confidence(value, half, sign=""):
    """To the second digit of what is uncertain, as in "198.40 ± 0.12"."""
    if math.isnan(value):
        return ""
    if math.isnan(half):
        return f"{value:{sign}.4g}"
    if half == 0:
        return f"{value:{sign}.6g} ± 0"
    decimals = min(max(0, 1 - math.floor(math.log10(half))), 6)
    return f"{value:{sign}.{decimals}f} ± {half:.{decimals}f}"
