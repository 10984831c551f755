"""What verdicts say of scenes, alone and told by each other: a table. Arguments: the folder of the verdicts, the scenes."""

import json
import pathlib
import sys

folder, scenes = pathlib.Path(sys.argv[1]), sys.argv[2:]


def verdict(name):
    return json.loads((folder / f"{name}.json").read_text())


def named(of):
    for effect in of["effects"]:
        numbers = (f"{row['name']} {row['value']:.3g}" for row in effect["parameters"])
        yield f"`{effect['name']}` ({', '.join(numbers)})"


def rms(of, key):
    return f"{of['held_out'][key]:.2f}"


print("| scene | named | unseen frames, as sinusoids | with what is named | " + " | ".join(f"told by {of}" for of in scenes) + " |")
print("|---|---|---|---|" + "---|" * len(scenes))
for scene in scenes:
    alone = verdict(scene)
    told = ("" if other == scene else rms(verdict(f"{scene}-by-{other}"), "rms_dn_before") for other in scenes)
    cells = [scene, " and ".join(named(alone)) or alone["verdict"], rms(alone, "rms_dn_before"), rms(alone, "rms_dn_after"), *told]
    print("| " + " | ".join(cells) + " |")
