#!/usr/bin/env python3
"""What few phase steps make of the phase, against many: wiggling.py MANY FEW CYCLES

MANY and FEW are folders that `vuris process` wrote of the same pixels. Printed: amplitude of the part of the phase's
difference that has CYCLES cycles a turn, and the RMS of the difference with and without it, over the pixels whose
amplitude is at least LEAST_DN in both. The mean difference is taken away.
"""

import cmath
import math
import sys

import npy

LEAST_DN = 10.0


def rms(values):
    return math.sqrt(sum(value * value for value in values) / len(values))


def main():
    many, few, cycles = sys.argv[1], sys.argv[2], int(sys.argv[3])
    phases = [npy.read(f"{folder}/reference_phase_turns.npy")[1] for folder in (many, few)]
    amplitudes = [npy.read(f"{folder}/reference_amplitude_dn.npy")[1] for folder in (many, few)]
    pairs = []
    for one, other, strong, also in zip(*phases, *amplitudes):
        if strong >= LEAST_DN and also >= LEAST_DN:
            pairs.append((math.tau * one, math.tau * (other - one)))
    mean = cmath.phase(sum(cmath.rect(1, difference) for _, difference in pairs))
    apart = [math.remainder(difference - mean, math.tau) for _, difference in pairs]
    # Not every phase is equally frequent: cosine, sine and mean are fitted together.
    waves = [(1.0, math.cos(cycles * phase), math.sin(cycles * phase)) for phase, _ in pairs]
    normal = [[sum(wave[i] * wave[j] for wave in waves) for j in range(3)] for i in range(3)]
    right = [sum(wave[i] * value for wave, value in zip(waves, apart)) for i in range(3)]
    for i in range(3):
        for j in range(i + 1, 3):
            factor = normal[j][i] / normal[i][i]
            normal[j] = [a - factor * b for a, b in zip(normal[j], normal[i])]
            right[j] -= factor * right[i]
    found = [0.0] * 3
    for i in (2, 1, 0):
        found[i] = (right[i] - sum(normal[i][j] * found[j] for j in range(i + 1, 3))) / normal[i][i]
    rest = [value - sum(f * w for f, w in zip(found, wave)) for value, wave in zip(apart, waves)]
    amplitude = 1e3 * math.hypot(found[1], found[2])
    print(
        f"{len(pairs)} pixels of at least {LEAST_DN:.0f} DN: {amplitude:.1f} mrad in {cycles} cycles a turn; "
        f"difference {1e3 * rms(apart):.1f} mrad RMS, {1e3 * rms(rest):.1f} without these"
    )


if __name__ == "__main__":
    main()
