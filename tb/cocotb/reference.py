"""What the core should say, in double precision.

The numbers come from doc/explanation.json, which `vuris generate` writes beside the core; the arithmetic is numpy's. Nothing
here knows the model or the golden vectors of the core.
"""

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

SPEED_OF_LIGHT_M_S = 299_792_458.0


@dataclass
class Truth:
    """The exact results of one set, a value a pixel."""

    turns: np.ndarray
    amplitude_dn: np.ndarray
    offset_dn: np.ndarray
    is_vector: np.ndarray
    fills_word: np.ndarray
    saturated: np.ndarray


class Core:
    """A generated core: its folder's explanation.json, with what a test wants from it."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.numbers = json.loads((self.folder / "doc/explanation.json").read_text())
        assert self.numbers["format"] == "vuris-explanation/1"
        self.specification = self.numbers["specification"]
        sensor, modulation = self.specification["sensor"], self.specification["modulation"]
        self.width, self.height = sensor["width"], sensor["height"]
        self.pixels = self.width * self.height
        self.full_scale = 2 ** sensor["adc_bits"] - 1
        self.sample_bits = self.port("s_axis_tdata")["bits"]
        self.saturation_dn = sensor["saturation_dn"]
        self.silence_clocks = sensor["line_blanking_clocks"]
        self.repeats = modulation["frames_per_step"]
        self.frames = self.numbers["frames_per_set"]
        self.range_m = SPEED_OF_LIGHT_M_S / (2 * modulation["frequency_hz"])
        self.timing = self.numbers["timing"]
        self.error = self.numbers["error"]
        self.fields = {field["name"]: field for field in self.numbers["result"]["fields"]}

    def port(self, name):
        return next(port for port in self.numbers["ports"] if port["name"] == name)

    def field(self, words, name):
        """The field `name` of result words."""
        low, bits = self.fields[name]["low"], self.fields[name]["bits"]
        return np.array([word >> low & (1 << bits) - 1 for word in words], dtype=np.int64)

    def spare_bits(self, words):
        """Those bits of result words that no field covers."""
        covered = sum((1 << field["bits"]) - 1 << field["low"] for field in self.fields.values())
        return [word & ~covered for word in words]

    def of_frames(self, steps):
        """What every raw frame of a set has, in the order in which they come, of what every step has."""
        return np.repeat(np.array(steps)[self.numbers["steps_in_order"]], self.repeats)

    def truth(self, codes):
        """The results of one set's codes, [raw frame, pixel]."""
        scheme = self.numbers["scheme"]
        weights = {name: self.of_frames(scheme[name]) for name in ("in_phase", "quadrature", "offset")}
        dn = np.minimum(codes, self.full_scale).astype(float)
        x, q = weights["in_phase"] @ dn, weights["quadrature"] @ dn
        y = np.sqrt(scheme["quadrature_factor_squared"]) * q
        magnitude_bits = max(self.numbers["words"][name]["bits"] for name in ("in_phase", "quadrature")) - 1
        return Truth(
            turns=np.arctan2(y, x) / (2 * np.pi) % 1,
            amplitude_dn=np.hypot(x, y) / (scheme["gain"] * self.repeats),
            offset_dn=weights["offset"] @ dn / (scheme["offset_gain"] * self.repeats),
            is_vector=(x != 0) | (y != 0),
            fills_word=np.maximum(np.abs(x), np.abs(q)) >= 2 ** (magnitude_bits - 1),
            saturated=dn.max(axis=0) >= self.saturation_dn,
        )

    def frames_of(self, turns, amplitude_dn, offset_dn):
        """Raw frames of a scene, [raw frame, pixel], as the scheme steps the phase; not noisy, rounded to codes."""
        angles = np.array([numerator / denominator for numerator, denominator in self.numbers["scheme"]["angles_turns"]])
        step = self.of_frames(angles)[:, None]
        dn = amplitude_dn * np.cos(2 * np.pi * (step - turns)) + offset_dn
        return np.clip(np.rint(dn), 0, self.full_scale).astype(np.int64)

    def strongest(self):
        """Codes, [raw frame, pixel], of the longest vector that there is, which need not be shifted up: its timing is the diagrams'."""
        scheme, words = self.numbers["scheme"], self.numbers["words"]
        name = max(("in_phase", "quadrature"), key=lambda name: words[name]["bits"])
        weights = self.of_frames(scheme[name])
        sign = 1 if weights[weights > 0].sum() >= -weights[weights < 0].sum() else -1
        codes = np.where(weights * sign > 0, self.full_scale, 0)
        return np.repeat(codes[:, None], self.pixels, axis=1)

    def check(self, words, codes):
        """Compares one set's result words with its codes' truth; the largest phase error, in codes of the phase."""
        truth = self.truth(codes)
        assert not any(self.spare_bits(words)), "a bit that no field covers is set"
        phase = self.field(words, "phase")
        assert np.array_equal(self.field(words, "saturated"), truth.saturated), "saturation flags"
        usable = truth.is_vector
        if "amplitude" in self.fields:
            usable = usable & (self.field(words, "amplitude") >= self.numbers["minimum_amplitude_codes"])
        assert np.array_equal(self.field(words, "usable"), usable), "usable flags"
        for name in set(self.fields) - {"offset", "saturated"}:
            assert not self.field(words, name)[~truth.is_vector].any(), f"{name} without a vector"

        # Double precision is exact to far below a code; a part in 10^9 of one is left to it.
        slack = 1e-9
        code = {name: self.fields[name]["code"] for name in self.fields}

        def within(name, error, limit):
            worst = np.argmax(np.abs(error) - limit)
            assert abs(error[worst]) <= limit[worst] + slack, (
                f"{name} of pixel {worst} is off by {error[worst]} codes, {limit[worst]} at most"
            )

        # The short way round, and nothing where there is no phase, or one of a weak vector that is not shifted up.
        error = ((phase * code["phase"] - truth.turns + 0.5) % 1 - 0.5) / code["phase"]
        exact = truth.is_vector if self.numbers["normalised"] else truth.fills_word
        error[~exact] = 0
        within("phase", error, np.full(error.shape, self.error["phase"]["codes"]))
        expected = {
            "offset": truth.offset_dn / code["offset"],
            "distance": phase * code["phase"] * self.range_m / code["distance"],
        }
        if "amplitude" in self.fields:
            expected["amplitude"] = np.where(exact, truth.amplitude_dn / code["amplitude"], self.field(words, "amplitude"))
        for name, value in expected.items():
            bound = self.error[name]
            within(name, self.field(words, name) - value, bound["codes"] + bound["relative"] * value)
        return np.abs(error).max()
