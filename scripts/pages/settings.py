#!/usr/bin/env python3
"""The largest steps from a frame to the next among the settings that a verdict names: settings.py VERDICT.json

Of `phase_step_errors` or `frame_gain`, whichever is named. What is the same from each frame to the next, as a light that
fades evenly, is taken away with the median of the steps.
"""

import json
import re
import statistics
import sys

SHOWN = 8
EFFECTS = {"phase_step_errors": "mrad", "frame_gain": "1/1000"}


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        verdict = json.load(file)
    named = [effect for effect in verdict["effects"] if effect["name"] in EFFECTS]
    if not named:
        print("Neither `phase_step_errors` nor `frame_gain` is named.")
        return
    effect = named[0]
    frames = verdict["held_out"]["by_frames"][0]["frames"]
    settings = [p["value"] for p in effect["parameters"] if re.search(r"_\d+", p["name"])][:frames]
    steps = [1e3 * (after - before) for before, after in zip(settings, settings[1:])]
    middle = statistics.median(steps)
    ranked = sorted(enumerate(steps, 1), key=lambda step: -abs(step[1] - middle))
    print(f"| step of `{effect['name']}` to frame | {EFFECTS[effect['name']]}, less the median |")
    print("| ---: | ---: |")
    for frame, step in ranked[:SHOWN]:
        print(f"| {frame} | {step - middle:+.1f} |")


if __name__ == "__main__":
    main()
