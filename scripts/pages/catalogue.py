"""Campaigns by the textbook's formulas, in numpy, an effect a line: a generator that shares neither code nor language with the
program that diagnoses them.

    python catalogue.py make DIR SEED STRENGTH     campaigns DIR/NAME
    python catalogue.py names                      their names
    python catalogue.py table DIR DIR DIR          what the verdicts DIR/NAME.json of three strengths are worth, as a table

A frame is A sum_m a_m cos(m (theta - phi) + p_m) + B + ambient light, phi = 4 pi f d / c; electrons are Poisson's, read noise normal, codes whole.
"""

import json
import sys
import zlib
from itertools import permutations
from pathlib import Path
from types import SimpleNamespace

LIGHT_M_S = 299_792_458.0
FREQUENCY_HZ, FRAME_PERIOD_S = 30e6, 0.025
WIDTH, HEIGHT, FOCAL_LENGTH_PX = 24, 18, 33.0
FULL_SCALE, PEDESTAL_DN, GAIN_E_DN, READ_NOISE_E = 4095, 64.0, 12.0, 36.0
AMPLITUDES, PHASES_RAD = [1.0, 0.0, 0.024129, 0.0, 0.003372], [0.0, 0.0, -0.2421, 0.0, -0.4719]
BACKGROUND_M, ENCODER_M = 3.4, 1.5e-4
STEPS_RAD = {4: 1.570796326795, 5: 2.094395102393}
FOUR, FIVE = STEPS_RAD


def waveform(**harmonics):
    """Further harmonics of the correlation, as m = amplitude."""

    def act(frame):
        for m, amplitude in harmonics.items():
            angle = int(m[1:]) * (frame.angle_rad - frame.phase_rad) + 0.5
            frame.wave += frame.strength * amplitude * np.cos(angle)

    return "wave", act


def fading(share):
    """All of the camera's light, by a function of the frame."""

    def act(frame):
        factor = 1 + frame.strength * share(frame)
        frame.amplitude_dn, frame.constant_dn = frame.amplitude_dn * factor, frame.constant_dn * factor

    return "light", act


def gains(of):
    """Single frames of a set brighter by a share, {(frames of the set, frame): share}."""
    return fading(lambda frame: of.get((frame.count, frame.number), 0.0))


def add(stage, name, value):
    """Adds a value of the frame to its number `name`."""

    def act(frame):
        setattr(frame, name, getattr(frame, name) + frame.strength * value(frame))

    return stage, act


def lag(share):
    """Charge of the frame before that is still there."""

    def act(frame):
        before = frame.dn if frame.before is None else frame.before
        frame.dn = frame.dn + frame.strength * share * (before - frame.dn)
        frame.kept = frame.dn

    return "image", act


def neighbours(frame):
    around = np.pad(frame.dn, 1, mode="edge")
    return around[:-2, 1:-1] + around[2:, 1:-1] + around[1:-1, :-2] + around[1:-1, 2:] - 4 * frame.dn


def emitter_beside(frame, beside_m):
    """By how much the way out is longer from an emitter beside the lens."""
    column_m = (columns - (WIDTH - 1) / 2) / FOCAL_LENGTH_PX * frame.axial_m
    row_m = (rows - (HEIGHT - 1) / 2) / FOCAL_LENGTH_PX * frame.axial_m
    return np.sqrt((column_m - beside_m) ** 2 + row_m**2 + frame.axial_m**2) - frame.range_m


def second_path(longer_m, share):
    """Light that comes back by a way that is longer by `longer_m` there and back, with a share of the target's own."""

    def act(frame):
        scene, more_m = frame.scene, longer_m(frame.range_m)
        angle = frame.angle_rad - frame.phase_rad - TURN * FREQUENCY_HZ * more_m / LIGHT_M_S
        wave = sum(a * np.cos(m * angle + p) for m, (a, p) in enumerate(zip(AMPLITUDES, PHASES_RAD), 1) if a)
        part = frame.strength * share(frame.range_m, more_m) * scene.mask
        frame.ambient_dn = frame.ambient_dn + part * (frame.amplitude_dn * wave + frame.constant_dn)

    return "ambient", act


def forgotten(effect):
    """What the camera's description does not include: it has no strength."""
    return "camera", effect


def edges(frame):
    """What a pixel at the target's edge would see more if it saw what is beyond."""
    padded, mask = np.pad(frame.dn, 1, mode="edge"), np.pad(frame.scene.mask, 1, mode="edge")
    around = np.s_[:-2, 1:-1], np.s_[2:, 1:-1], np.s_[1:-1, :-2], np.s_[1:-1, 2:]
    beyond = [(padded[side], mask[side] != frame.scene.mask) for side in around]
    count = sum(is_other.astype(int) for _, is_other in beyond)
    return sum(np.where(is_other, dn - frame.dn, 0.0) for dn, is_other in beyond) / np.maximum(count, 1)


def sideways(frame, moved_px):
    """The image moved to the right by a part of a pixel."""
    return moved_px * (np.pad(frame.dn, 1, mode="edge")[1:-1, :-2] - frame.dn)


FULL_DN = FULL_SCALE - PEDESTAL_DN
TURN = 6.283185307179586
SCALE = add("clock", "angle_rad", lambda f: 0.004 * f.number * STEPS_RAD[f.count])
ERRORS = add("clock", "angle_rad", lambda f: 0.006 * f.errors[f.count][f.number])
WALK = add("path", "phase_rad", lambda f: 0.004 * np.log(f.amplitude_dn / 100.0))
WARM = add("path", "phase_rad", lambda f: 0.01 * (1 - np.exp(-f.time_s / 8.0)))
MAINS = add("ambient", "ambient_dn", lambda f: 0.02 * f.ambient_dn * np.cos(TURN * 100.03 * (f.began_s + f.time_s)))
BRIGHTER = add("ambient", "ambient_dn", lambda f: 3e-3 * f.ambient_dn * f.time_s)
FULL = ("response", lambda f: setattr(f, "dn", np.minimum(f.dn, 1500.0 / f.strength**0.5)))
BENT = add("response", "dn", lambda f: 0.03 * f.dn**2 / FULL_DN)
COUPLED = add("response", "dn", lambda f: 0.6 * np.cos(f.angle_rad - 1.0))
VEILED = add("image", "dn", lambda f: 0.01 * (f.dn.mean() - f.dn))
SPREAD = add("image", "dn", lambda f: 0.0025 * neighbours(f))
JITTER = add("path", "phase_rad", lambda f: 0.003 * f.rng.standard_normal())
FASTER = add("path", "phase_rad", lambda f: 0.002 * 2 * TURN * FREQUENCY_HZ * f.range_m / LIGHT_M_S)
DIMMER = fading(lambda f: -0.005 * (1 - np.exp(-f.time_s / 10.0)))
WALL = second_path(lambda d: np.sqrt(d * d + 4 * 0.6**2) - d, lambda d, more: 0.03 * d / (d + more))
ZERO = add("encoder", "read_m", lambda f: -0.02)
SCREW = add("encoder", "read_m", lambda f: 6e-4 * np.sin(TURN * f.place_m / 0.37 + 1.0))
TAPS = add("response", "dn", lambda f: 0.002 * (f.number % 2 - 0.5) * f.dn)
EDGES = add("image", "dn", lambda f: 0.03 * edges(f))
DROOP = fading(lambda f: -0.002 * f.number / (f.count - 1))

# Name: what it does, what may be named (each of one of a set), or, of what no library has, where it lives.
CASES = {
    "clean": ([], []),
    "duty-cycle": ([waveform(h2=0.004, h4=0.002)], [{"correlation_harmonics"}]),
    "third-harmonic": ([waveform(h3=0.006)], [{"correlation_harmonics"}]),
    "step-scale": ([SCALE], [{"phase_step_scale"}]),
    "step-errors": ([ERRORS], [{"phase_step_errors"}]),
    "quadrature-gain": ([gains({(FOUR, 1): 0.003, (FOUR, 3): 0.003})], [{"frame_gain"}]),
    "one-frame-brighter": ([gains({(FOUR, 2): 0.002, (FIVE, 2): 0.002})], [{"frame_gain"}]),
    "ambient-drift": ([BRIGHTER], [{"ambient_drift"}]),
    "mains-flicker": ([MAINS], [{"ambient_flicker"}]),
    "well-full": ([FULL], [{"saturation"}]),
    "quadratic-response": ([BENT], [{"intensity_nonlinearity"}]),
    "cubic-response": ([add("response", "dn", lambda f: 0.08 * f.dn**3 / FULL_DN**2)], [{"intensity_nonlinearity"}]),
    "walk": ([WALK], [{"intensity_related_phase"}]),
    "warm-up": ([WARM], [{"phase_drift"}]),
    "source-decay": ([DIMMER], [{"illumination_drift"}]),
    "droop": ([DROOP], [{"illumination_droop"}]),
    "image-lag": ([lag(0.003)], [{"image_lag"}]),
    "feed-through": ([COUPLED], [{"electrical_crosstalk"}]),
    "stray-light": ([VEILED], [{"lens_scatter"}]),
    "diffusion": ([SPREAD], [{"charge_crosstalk"}]),
    "wrong-frequency": ([FASTER], [{"modulation_frequency_error", "encoder_scale"}]),
    "clock-jitter": ([JITTER], [{"clock_jitter"}]),
    "late-frames": ([add("clock", "time_s", lambda f: 5e-4 * f.rng.standard_normal())], [{"timing_jitter_of_frames"}]),
    "converter": ([add("code", "code", lambda f: 1.2 * np.sin(TURN * f.code / 256.0))], [{"adc_nonlinearity"}]),
    "walk+flicker": ([WALK, MAINS], [{"intensity_related_phase"}, {"ambient_flicker"}]),
    "lag+step-errors": ([lag(0.004), ERRORS], [{"image_lag"}, {"phase_step_errors"}]),
    "harmonics+droop": ([waveform(h2=0.003, h5=0.003), DROOP], [{"correlation_harmonics"}, {"illumination_droop"}]),
    "warm-up+response": ([WARM, BENT], [{"phase_drift"}, {"intensity_nonlinearity"}]),
    "stray-light+feed-through": ([VEILED, COUPLED], [{"lens_scatter"}, {"electrical_crosstalk"}]),
    "drift+step-scale": ([BRIGHTER, SCALE], [{"ambient_drift"}, {"phase_step_scale"}]),
    "diffusion+clock-jitter": ([SPREAD, JITTER], [{"charge_crosstalk"}, {"clock_jitter"}]),
    "frequency+decay": ([FASTER, DIMMER], [{"modulation_frequency_error", "encoder_scale"}, {"illumination_drift"}]),
    "falloff-forgotten": ([forgotten("inverse_square_falloff")], [{"inverse_square_falloff"}]),
    "motion-forgotten": ([forgotten("axial_motion_of_recorded_velocity")], [{"axial_motion"}]),
    "wall-beside": ([WALL], [{"multipath_interference"}]),
    "wall-behind": ([second_path(lambda d: 1.6 + 0 * d, lambda d, more: 0.02 * (d / (d + more / 2)) ** 2)], [{"multipath_interference"}]),
    "encoder-long": ([add("encoder", "read_m", lambda f: -0.003 * f.place_m)], [{"encoder_scale", "modulation_frequency_error"}]),
    "encoder-zero": ([ZERO], [{"encoder_offset"}]),
    "lead-screw": ([SCREW], [{"encoder_cyclic"}]),
    "two-taps": ([TAPS], [{"tap_mismatch"}]),
    "sideways": ([add("image", "dn", lambda f: sideways(f, 0.4 * (f.time_s - f.set_s)))], [{"lateral_motion"}]),
    "edges": ([EDGES], [{"mixed_pixels"}]),
    "speckle": ([add("response", "dn", lambda f: 0.006 * f.dn * f.rng.standard_normal(f.dn.shape))], [{"excess_noise"}]),
    "feed-through+step-scale": ([COUPLED, SCALE], [{"electrical_crosstalk"}, {"phase_step_scale"}]),
    "falloff-forgotten+harmonics": (
        [forgotten("inverse_square_falloff"), waveform(h2=0.004, h4=0.004)],
        [{"inverse_square_falloff"}, {"correlation_harmonics"}],
    ),
    "motion-forgotten+flicker": (
        [forgotten("axial_motion_of_recorded_velocity"), MAINS],
        [{"axial_motion"}, {"ambient_flicker"}],
    ),
    "lag+wall": ([lag(0.003), WALL], [{"image_lag"}, {"multipath_interference"}]),
    "zero+step-errors": ([ZERO, ERRORS], [{"encoder_offset"}, {"phase_step_errors"}]),
    "screw+droop": ([SCREW, DROOP], [{"encoder_cyclic"}, {"illumination_droop"}]),
    "edges+drift": ([EDGES, BRIGHTER], [{"mixed_pixels"}, {"ambient_drift"}]),
    "taps+stray-light": ([TAPS, VEILED], [{"tap_mismatch"}, {"lens_scatter"}]),
    "wall+response": ([WALL, BENT], [{"multipath_interference"}, {"intensity_nonlinearity"}]),
    "flicker+harmonics": ([MAINS, waveform(h3=0.006)], [{"ambient_flicker"}, {"correlation_harmonics"}]),
    "every-other-set": ([fading(lambda f: 0.0015 * (-1) ** f.set)], "set"),
    "shade": ([fading(lambda f: -0.01 * np.exp(-(((f.place_m - 1.7) / 0.12) ** 2)))], "position_m"),
    "gain-of-offset": ([fading(lambda f: 0.002 * np.cos(3 * f.offset_rad + 0.4))], "phase"),
    "late-columns": (
        [add("path", "phase_rad", lambda f: 2 * TURN * FREQUENCY_HZ * f.velocity_m_s * 4e-5 * columns * f.scene.mask / LIGHT_M_S)],
        "column velocity_m_s",
    ),
    "dark-columns-late": ([add("path", "phase_rad", lambda f: 0.02 * (columns / WIDTH - 0.5) * (f.amplitude_dn / 400.0))], "column amplitude"),
    "thermostat": ([add("path", "phase_rad", lambda f: 0.004 * np.sign(np.sin(TURN * f.time_s / 11.0)))], "time_s set"),
    "second-camera": (
        [add("image", "dn", lambda f: 0.8 * np.cos(TURN * 0.37 * f.time_s + f.angle_rad) * (1 + 0.3 * columns / WIDTH))],
        [{"multi_camera_interference"}],
    ),
    "shutter-late": (
        [add("clock", "time_s", lambda f: [0, 0.002, -0.001, 0.0015, -0.002][f.number])],
        [{"frame_timing_error"}],
    ),
    "emitter-beside-lens": (
        [add("path", "phase_rad", lambda f: TURN * FREQUENCY_HZ / LIGHT_M_S * emitter_beside(f, 0.15))],
        [{"illumination_baseline"}],
    ),
    "background-suppression": ([add("response", "dn", lambda f: 2.0 * (f.dn > 700.0))], "code amplitude"),
    "bands": ([add("response", "dn", lambda f: 0.5 * np.sin(TURN * (rows / 6.0 + 1.7 * f.time_s)))], "row time_s"),
}
STAGES = ["camera", "encoder", "clock", "light", "path", "wave", "ambient", "image", "response", "code"]


def schedule():
    """Recordings: kind, frames of a set, and of each set its time, place, velocity and phase offset."""
    for frames, scheme in ((FOUR, "four"), (FIVE, "wdft")):
        length_s = frames * FRAME_PERIOD_S
        still_s = length_s + 7 * FRAME_PERIOD_S
        places = [(1.0 + 0.05 * n, 0.0) for n in range(45) for _ in range(2)]
        yield f"{scheme}-rail", "rail", frames, [(n * still_s, *place, 0.0) for n, place in enumerate(places)]
        offsets = [TURN * n / 48 for n in range(48) for _ in range(2)]
        yield f"{scheme}-sweep", "phase_sweep", frames, [(n * still_s, 2.0, 0.0, offset) for n, offset in enumerate(offsets)]
        runs, time_s = [], 0.0
        for velocity_m_s in (0.5, -0.5, 1.0, -1.0, 2.0, -2.0):
            place_m = 1.0 if velocity_m_s > 0 else 3.2
            while 0.99 < place_m < 3.21:
                runs.append((time_s, place_m, velocity_m_s, 0.0))
                time_s, place_m = time_s + length_s, place_m + velocity_m_s * length_s
            time_s += 2.0
        yield f"{scheme}-motion", "motion", frames, runs


def pass_stage(stage, frame, acts):
    for of, act in acts:
        if of == stage:
            act(frame)


def expose(frame, scene, acts):
    """The codes of one frame."""
    pass_stage("clock", frame, acts)
    gone_m = frame.velocity_m_s * (frame.time_s - frame.set_s)
    frame.axial_m = np.where(scene.mask, frame.place_m + gone_m, BACKGROUND_M)
    frame.range_m = frame.axial_m * scene.obliquity
    frame.amplitude_dn, frame.constant_dn = scene.amplitude_dn / frame.range_m**2, scene.constant_dn / frame.range_m**2
    pass_stage("light", frame, acts)
    frame.phase_rad = scene.phase_rad + 2 * TURN * FREQUENCY_HZ * frame.range_m / LIGHT_M_S
    pass_stage("path", frame, acts)
    angle = frame.angle_rad - frame.phase_rad
    harmonics = enumerate(zip(AMPLITUDES, PHASES_RAD), 1)
    frame.wave = sum(a * np.cos(m * angle + p) for m, (a, p) in harmonics if a)
    pass_stage("wave", frame, acts)
    frame.ambient_dn = scene.ambient_dn.copy()
    pass_stage("ambient", frame, acts)
    frame.dn = frame.amplitude_dn * frame.wave + frame.constant_dn + frame.ambient_dn
    pass_stage("image", frame, acts)
    pass_stage("response", frame, acts)
    electrons = frame.rng.poisson(np.maximum(frame.dn, 0) * GAIN_E_DN) + READ_NOISE_E * frame.rng.standard_normal(frame.dn.shape)
    frame.code = electrons / GAIN_E_DN + PEDESTAL_DN
    pass_stage("code", frame, acts)
    return np.clip(np.round(frame.code), 0, FULL_SCALE)


def make_scene(rng):
    texture = 0.4 + 0.6 * np.kron(rng.random((6, 8)), np.ones((3, 3)))
    amplitude_dn = 900 * texture * (1 + 0.02 * rng.standard_normal((HEIGHT, WIDTH)))
    aside = (columns - (WIDTH - 1) / 2) ** 2 + (rows - (HEIGHT - 1) / 2) ** 2
    return SimpleNamespace(
        amplitude_dn=amplitude_dn,
        constant_dn=1.25 * amplitude_dn * (1 + 0.01 * rng.standard_normal((HEIGHT, WIDTH))),
        phase_rad=0.05 * rng.standard_normal((HEIGHT, WIDTH)),
        ambient_dn=90.0 * (1 + 0.1 * rng.standard_normal((HEIGHT, WIDTH))),
        obliquity=np.sqrt(1 + aside / FOCAL_LENGTH_PX**2),
        mask=(rows >= 3) & (rows < 15) & (columns >= 4) & (columns < 20),
    )


KNOWN = ["axial_motion_of_recorded_velocity", "inverse_square_falloff"]


def make_campaign(folder, acts, strength, rng):
    left_out = [of for stage, of in acts if stage == "camera"]
    scene = make_scene(rng)
    errors = {frames: rng.standard_normal(frames) for frames in STEPS_RAD}
    folder.mkdir(parents=True)
    (folder / "camera.toml").write_text(
        f"[sensor]\nwidth = {WIDTH}\nheight = {HEIGHT}\nadc_bits = 12\npedestal_dn = {PEDESTAL_DN}\n"
        f"gain_e_per_dn = {GAIN_E_DN}\nread_noise_e = {READ_NOISE_E}\nfocal_length_px = {FOCAL_LENGTH_PX}\n\n"
        f"[correlation]\namplitude = {AMPLITUDES}\nphase_rad = {PHASES_RAD}\n\n"
        f"[physics]\nincluded = {json.dumps([name for name in KNOWN if name not in left_out])}\n"
    )
    for name, kind, count, sets in schedule():
        began_s, before, lines = rng.uniform(0, 100), None, ["set,time_s,position_m,velocity_m_s,phase_offset_rad"]
        codes = np.zeros((len(sets), count, HEIGHT, WIDTH), "<u2")
        for number, (set_s, place_m, velocity_m_s, offset_rad) in enumerate(sets):
            reading = SimpleNamespace(strength=strength, place_m=place_m, read_m=place_m + ENCODER_M * rng.standard_normal())
            pass_stage("encoder", reading, acts)
            lines.append(f"{number},{set_s:.6f},{reading.read_m:.5f},{velocity_m_s},{offset_rad:.9f}")
            for n in range(count):
                frame = SimpleNamespace(
                    rng=rng, scene=scene, strength=strength, errors=errors, began_s=began_s, before=before, kept=None, count=count, number=n,
                    set=number, offset_rad=offset_rad,
                    set_s=set_s, time_s=set_s + n * FRAME_PERIOD_S, place_m=place_m, velocity_m_s=velocity_m_s,
                    angle_rad=n * STEPS_RAD[count] + offset_rad,
                )  # fmt: skip
                codes[number, n] = expose(frame, scene, acts)
                before = frame.kept
        recording = folder / name
        recording.mkdir()
        np.save(recording / "frames.npy", codes)
        np.save(recording / "mask.npy", scene.mask.astype("u1"))
        (recording / "sets.csv").write_text("\n".join(lines) + "\n")
        (recording / "recording.toml").write_text(
            f'format = "vuris-recording/1"\nkind = "{kind}"\n\n[modulation]\nfrequency_hz = {FREQUENCY_HZ}\nframes = {count}\n'
            f"phase_step_rad = {STEPS_RAD[count]}\n\n[timing]\nframe_period_s = {FRAME_PERIOD_S}\n"
        )


def make(folder, seed, strength):
    for name, (acts, _) in CASES.items():
        assert all(stage in STAGES for stage, _ in acts), name
        make_campaign(folder / name, acts, strength, np.random.default_rng([seed, zlib.crc32(name.encode())]))


def judged(name, verdict):
    """Right, possible, partly, silent or wrong, as the program's own challenges have it."""
    expected, named = CASES[name][1], [(effect["name"], effect["also_possible"]) for effect in verdict["effects"]]
    if verdict["verdict"] == "clean":
        return "silent" if expected else "right"
    if isinstance(expected, str):
        first = verdict["located"][0]["coordinate"] if verdict["located"] else ""
        unnamed = "right" if first in expected.split() else "partly"
        return "wrong" if named else unnamed
    if not expected:
        return "wrong"
    orders = permutations(named) if len(named) == len(expected) else []
    pairings = [list(zip(expected, order)) for order in orders]
    if any(all(effect in names for names, (effect, _) in pairing) for pairing in pairings):
        return "right"
    if any(all(names & {effect, *also} for names, (effect, also) in pairing) for pairing in pairings):
        return "possible"
    if not named:
        return "silent"
    is_there = all(any(effect in names for names in expected) for effect, _ in named)
    return "partly" if is_there else "wrong"


def said(verdict):
    effects = [
        f"`{effect['name']}`" + (f" (or {', '.join(effect['also_possible'])})" if effect["also_possible"] else "")
        for effect in verdict["effects"]
    ]
    word = verdict["verdict"].replace("_", " ")
    if effects:
        return ("" if word == "explained" else f"{word}: ") + " and ".join(effects)
    return word + (f", in {verdict['located'][0]['coordinate']}" if verdict["located"] else "")


STRENGTHS = "as above", "a third as strong", "three times as strong"


def table(folders):
    verdicts = {name: [json.loads((folder / f"{name}.json").read_text()) for folder in folders] for name in CASES}
    print("| what was done | the answer | | " + " | | ".join(STRENGTHS[1:]) + " | |\n|---" + "|---|---" * len(STRENGTHS) + "|")
    for name, of_name in verdicts.items():
        print(f"| {name} |", " | ".join(f"{said(verdict)} | {judged(name, verdict)}" for verdict in of_name), "|")
    for column, which in enumerate(STRENGTHS):
        marks = [judged(name, of_name[column]) for name, of_name in verdicts.items()]
        counts = [f"{marks.count(mark)} {mark}" for mark in ("right", "possible", "partly", "silent", "wrong")]
        print(f"\n{which}, of {len(marks)}: {', '.join(counts)}")


if __name__ == "__main__":
    if sys.argv[1] == "make":
        import numpy as np

        rows, columns = np.mgrid[0:HEIGHT, 0:WIDTH]
        make(Path(sys.argv[2]), int(sys.argv[3]), float(sys.argv[4]))
    elif sys.argv[1] == "names":
        print("\n".join(CASES))
    else:
        table([Path(folder) for folder in sys.argv[2:]])
