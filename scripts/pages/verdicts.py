#!/usr/bin/env python3
"""Rows of a table from verdicts of `vuris diagnose --json`: verdicts.py "what was concealed=FILE.json" ...

Each row: what was concealed, the verdict, what is named with its numbers, what the verdict says of the three candidates
that are not named, and the held-out frames and distances before and after.
"""

import json
import sys

CANDIDATES = ["inverse_square_falloff", "multipath_interference", "intensity_nonlinearity"]
MOST = 3  # numbers of an effect


def number(parameter):
    unit = "" if parameter["unit"] == "1" else f" {parameter['unit']}"
    return f"{parameter['name']} {parameter['value']:.5f} ± {parameter['sigma']:.5f}{unit}"


def named(effect):
    numbers = [number(p) for p in effect["parameters"][:MOST]]
    rest = len(effect["parameters"]) - len(numbers)
    more = f", and {rest} more" if rest else ""
    also = f"; also possible: {', '.join(effect['also_possible'])}" if effect["also_possible"] else ""
    return f"`{effect['name']}` ({', '.join(numbers)}{more}{also})"


def of_candidate(verdict, name):
    rows = [row["by"] for row in verdict["ruled_out"] if row["name"] == name]
    return f"{name}: {rows[0]}" if rows else f"{name}: nothing is said"


def row(what, verdict):
    effects = verdict["effects"]
    spoken_of = {effect["name"] for effect in effects} | {a for e in effects for a in e["also_possible"]}
    others = [of_candidate(verdict, name) for name in CANDIDATES if name not in spoken_of] if effects else []
    held = verdict["held_out"]
    cells = [
        what,
        verdict["verdict"].replace("_", " "),
        "<br>".join(map(named, effects)) or "nothing",
        "<br>".join(others),
        f"{held['frame_mean_rms_dn_before']:.3f} → {held['frame_mean_rms_dn_after']:.3f}",
        f"{1e3 * held['distance_rms_m_before']:.2f} → {1e3 * held['distance_rms_m_after']:.2f}",
    ]
    return "| " + " | ".join(cells) + " |"


def main():
    print("| concealed | verdict | named | of the other candidates | frames' means, DN | distance of a set, mm |")
    print("| --- | --- | --- | --- | --- | --- |")
    for argument in sys.argv[1:]:
        what, path = argument.rsplit("=", 1)
        with open(path, encoding="utf-8") as file:
            print(row(what, json.load(file)))


if __name__ == "__main__":
    main()
