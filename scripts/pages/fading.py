#!/usr/bin/env python3
"""How fast the light fades in nine regions, fitted without vuris, beside a verdict: fading.py RECORDING VERDICT.json

Each region's mean of every frame is fitted as a sinusoid of the phase steps and a constant, both times exp(-rate time).
Nothing else is free: no settings of the phase shifter.
"""

import csv
import json
import math
import sys

import npy

DARK_DN = 59.0  # the background code, by hand
SIDE = 3
RATES_PER_S = [0.00025 * n for n in range(-80, 160)]
NAMES = [
    *("top_left_per_s", "top_per_s", "top_right_per_s"),
    *("left_per_s", "middle_per_s", "right_per_s"),
    *("bottom_left_per_s", "bottom_per_s", "bottom_right_per_s"),
]


def region_means(folder):
    """Of each region, the mean of each frame, DN above the dark."""
    shape, codes = npy.read(f"{folder}/frames.npy")
    frames, rows, columns = shape[-3:]
    means = [[] for _ in NAMES]
    for frame in range(frames):
        sums, counts = [0] * len(NAMES), [0] * len(NAMES)
        for row in range(rows):
            at = (frame * rows + row) * columns
            for third in range(SIDE):
                part = codes[at + third * columns // SIDE : at + (third + 1) * columns // SIDE]
                region = row * SIDE // rows * SIDE + third
                sums[region] += sum(part)
                counts[region] += len(part)
        for region, mean in enumerate(means):
            mean.append(sums[region] / counts[region] - DARK_DN)
    return means


def left(means, times_s, rate_per_s):
    """Squares that are left of the best sinusoid and constant which fade at this rate."""
    rest, basis = list(means), []
    turn = math.tau / len(means)
    for wave in (lambda _: 1.0, lambda n: math.cos(turn * n), lambda n: math.sin(turn * n)):
        vector = [wave(n) * math.exp(-rate_per_s * time_s) for n, time_s in enumerate(times_s)]
        for other in basis:
            share = sum(a * b for a, b in zip(vector, other))
            vector = [a - share * b for a, b in zip(vector, other)]
        length = math.sqrt(sum(a * a for a in vector))
        basis.append([a / length for a in vector])
    for vector in basis:
        share = sum(a * b for a, b in zip(rest, vector))
        rest = [a - share * b for a, b in zip(rest, vector)]
    return sum(a * a for a in rest)


def main():
    folder, verdict = sys.argv[1:]
    with open(f"{folder}/frames.csv", encoding="utf-8") as file:
        times_s = [float(row["time_s"]) for row in csv.DictReader(file)]
    with open(verdict, encoding="utf-8") as file:
        effects = json.load(file)["effects"]
    told = {p["name"]: p for e in effects if e["name"] == "response_decay" for p in e["parameters"]}
    if not told:
        print("`response_decay` is not named.")
        return
    print("| region | the region's means alone, 1/s | `response_decay`, 1/s | difference |")
    print("| --- | ---: | ---: | ---: |")
    for name, means in zip(NAMES, region_means(folder)):
        alone = min(RATES_PER_S, key=lambda rate_per_s: left(means, times_s, rate_per_s))
        found = told[name]
        numbers = f"{alone:.4f} | {found['value']:.4f} ± {found['sigma']:.4f} | {alone - found['value']:.4f}"
        print(f"| {name.removesuffix('_per_s').replace('_', ' ')} | {numbers} |")


if __name__ == "__main__":
    main()
