"""The generated core as an outside user would try it: against numpy, with nothing but its folder.

VURIS_CORE is that folder; `run.py` sets it.
"""

import json
import os

import cocotb
import numpy as np

from bench import Bench, beats_of
from reference import Core

CORE = Core(os.environ["VURIS_CORE"])
SEED = int(os.environ.get("VURIS_SEED", "1"))


def scenes(rng):
    """Sets of every strength: name and codes, [raw frame, pixel]."""
    pixels, full = CORE.pixels, CORE.full_scale
    turns = rng.random(pixels)
    octave = np.exp2(rng.uniform(-1, np.log2(full / 2), pixels))
    yield "all phases, all amplitudes", CORE.frames_of(turns, octave, full / 2)
    yield "weak", CORE.frames_of(turns, rng.uniform(0, 4, pixels), rng.uniform(0, full, pixels))
    yield "beyond full scale", CORE.frames_of(turns, full, rng.uniform(0, full, pixels))
    yield "random codes", rng.integers(0, full + 1, (CORE.frames, pixels))
    corners = rng.choice([0, 1, full - 1, full], (CORE.frames, pixels))
    yield "corners", corners
    constant = np.broadcast_to(rng.integers(0, full + 1, pixels), (CORE.frames, pixels)).copy()
    yield "nothing but light", constant
    if full < 2**CORE.sample_bits - 1:
        beyond = rng.integers(0, full + 1, (CORE.frames, pixels))
        larger = rng.integers(full + 1, 2**CORE.sample_bits, beyond.shape)
        beyond = np.where(rng.random(beyond.shape) < 0.2, larger, beyond)
        yield "codes that the converter cannot make", beyond


async def compare(dut, pause, stop):
    bench = Bench(dut, CORE, SEED, pause, stop)
    await bench.start()
    sent = list(scenes(np.random.default_rng(SEED)))
    for _, codes in sent:
        await bench.send(beats_of(CORE, codes))
    await bench.rest()
    sets = bench.sets()
    assert len(sets) == len(sent), f"{len(sets)} sets of {len(sent)} have come out"
    for (name, codes), words in zip(sent, sets):
        worst = CORE.check(words, codes)
        dut._log.info("%s: phase off by %.3f codes at most, %.3f allowed", name, worst, CORE.error["phase"]["codes"])
    assert bench.counters() == (len(sent), 0)


@cocotb.test()
async def results_are_within_their_bounds_at_full_speed(dut):
    await compare(dut, pause=0, stop=0)


@cocotb.test()
async def results_are_within_their_bounds_with_pauses_and_back_pressure(dut):
    await compare(dut, pause=0.25, stop=0.4)


async def broken_between_good(dut, break_it):
    """A good set, a broken one, a good one: the broken one must not show, nor change the others."""
    bench = Bench(dut, CORE, SEED)
    await bench.start()
    rng = np.random.default_rng(SEED)
    first, broken, last = (rng.integers(0, CORE.full_scale + 1, (CORE.frames, CORE.pixels)) for _ in range(3))
    await bench.send(beats_of(CORE, first))
    await bench.send(break_it(beats_of(CORE, broken)))
    await bench.send(beats_of(CORE, last))
    await bench.rest()
    sets = bench.sets()
    assert len(sets) == 2, f"{len(sets)} sets have come out"
    CORE.check(sets[0], first)
    CORE.check(sets[1], last)
    assert bench.counters() == (2, 1)


@cocotb.test()
async def a_set_with_a_dropped_frame_does_not_come_out(dut):
    frame = CORE.frames // 2 * CORE.pixels
    await broken_between_good(dut, lambda beats: beats[:frame] + beats[frame + CORE.pixels :])


@cocotb.test()
async def a_set_with_a_dropped_sample_does_not_come_out(dut):
    lost = CORE.frames * CORE.pixels // 2 + 1
    await broken_between_good(dut, lambda beats: beats[:lost] + beats[lost + 1 :])


@cocotb.test()
async def a_reset_in_the_middle_of_a_set_leaves_nothing_behind(dut):
    bench = Bench(dut, CORE, SEED)
    await bench.start()
    rng = np.random.default_rng(SEED)
    lost, good = (rng.integers(0, CORE.full_scale + 1, (CORE.frames, CORE.pixels)) for _ in range(2))
    await bench.send(beats_of(CORE, lost)[: -CORE.pixels // 2])
    again = Bench(dut, CORE, SEED)
    dut.s_axis_tvalid.value = 0
    dut.rst_ni.value = 0
    for _ in range(2):
        await again.clock(None, True)
    again.check_reset()
    dut.rst_ni.value = 1
    await again.send(beats_of(CORE, good))
    await again.rest()
    (words,) = again.sets()
    CORE.check(words, good)
    assert again.counters() == (1, 0)


@cocotb.test()
async def the_next_frames_step_is_told_before_it_begins(dut):
    """What a modulation hardware that follows the outputs would make: every raw frame has the step that its set needs."""
    if not any(port["name"] == "next_frame_step_o" for port in CORE.numbers["ports"]):
        return
    bench = Bench(dut, CORE, SEED)
    await bench.start()
    beats = beats_of(CORE, np.random.default_rng(SEED).integers(0, CORE.full_scale + 1, (CORE.frames, CORE.pixels)))
    order, codes = CORE.numbers["steps_in_order"], CORE.numbers["step_phase_codes"]
    for number in range(2 * CORE.frames):
        frame = number % CORE.frames
        told = [int(handle.value) for handle in (dut.next_frame_first_o, dut.next_frame_step_o, dut.next_frame_phase_o)]
        step = order[frame // CORE.repeats]
        assert told == [frame == 0, step, codes[step]], f"frame {number}: told {told}, step {step} is due"
        await bench.send(beats[frame * CORE.pixels : (frame + 1) * CORE.pixels])
        # A frame's pause, short enough not to end the set.
        for _ in range(min(CORE.silence_clocks, 8)):
            await bench.clock(None, True)


def clocks_of(diagram):
    """A WaveJSON's signals in every clock that it draws or leaves out: a list of (drawn, {name: value}); what `x` hides is None."""
    signals = {lane["name"]: iter_lane(lane) for lane in diagram["signal"] if "name" in lane}
    gaps = iter(diagram["gap_clocks"])
    clocks = []
    for column, letter in enumerate(diagram["signal"][0]["wave"]):
        now = {name: values[column] for name, values in signals.items()}
        clocks += [(letter != "|", now)] * (next(gaps) if letter == "|" else 1)
    return clocks


def iter_lane(lane):
    values, labels, value = [], iter(lane.get("data", [])), None
    for letter in lane["wave"]:
        if letter in "01":
            value = letter
        elif letter == "=":
            value = next(labels)
        elif letter == "x":
            value = None
        values.append(value)
    return values


async def follow(dut, name):
    """Drives the core as the timing diagram shows and compares every output that it draws, clock by clock."""
    diagram = json.loads((CORE.folder / f"doc/{name}.json").read_text())
    clocks = clocks_of(diagram)
    bench = Bench(dut, CORE, SEED, pause=0, stop=0)
    await bench.start()
    codes = CORE.strongest()
    beats = beats_of(CORE, codes)
    # What comes before the first clock that is drawn.
    first = next(now["s_axis_tdata"] for drawn, now in clocks if drawn and now["s_axis_tdata"] is not None)
    await bench.send(beats[: int(first[1:])])
    number, shown_results = int(first[1:]), 0
    for clock, (drawn, now) in enumerate(clocks):
        beat = beats[number % len(beats)] if now["s_axis_tvalid"] == "1" else None
        if drawn and beat is not None:
            assert now["s_axis_tdata"] == f"s{number % len(beats)}", f"{name}, clock {clock}: sample {number} is due"
            assert (now["s_axis_tlast"], now["s_axis_tuser"]) == (str(int(beat.last)), str(int(beat.user)))
        shown = await bench.clock(beat, now["m_axis_tready"] == "1")
        if drawn:
            found = {"s_axis_tready": str(shown.s_ready), "m_axis_tvalid": str(shown.m_valid)}
            if shown.m_valid:
                found |= {"m_axis_tlast": str(shown.m_last), "m_axis_tuser": str(shown.m_user)}
                found["m_axis_tdata"] = f"r{shown_results}"
            for signal, value in found.items():
                assert now[signal] == value, f"{name}, clock {clock}: {signal} is {value}, drawn as {now[signal]}"
        number += bool(beat is not None and shown.s_ready)
        shown_results = len(bench.results)
    CORE.check([word for word, _, _ in bench.results], codes[:, : len(bench.results)])
    return diagram


@cocotb.test()
async def the_weakest_set_takes_no_longer_than_stated(dut):
    """No vector at all, and the weakest: every clock that shifting them up can take."""
    timing = CORE.timing
    bench = Bench(dut, CORE, SEED, pause=0, stop=0)
    await bench.start()
    codes = np.zeros((CORE.frames, CORE.pixels), dtype=np.int64)
    codes[0, ::2] = 1
    await bench.send(beats_of(CORE, codes))
    clocks = 0
    while len(bench.results) < CORE.pixels:
        await bench.clock(None, True)
        clocks += 1
        first = timing["silence_to_first_result_clocks"] + timing["most_shifts"]
        assert clocks <= first + CORE.pixels * timing["most_clocks_a_result"], "slower than stated"
    CORE.check([word for word, _, _ in bench.results], codes)


@cocotb.test()
async def the_diagram_of_a_set_is_what_happens(dut):
    diagram = await follow(dut, "timing-set")
    assert diagram["edge"] == [f"a<->b {CORE.timing['silence_to_first_result_clocks']} clocks"]


@cocotb.test()
async def the_diagram_of_the_next_set_is_what_happens(dut):
    diagram = await follow(dut, "timing-next-set")
    assert diagram["edge"] == [f"a<->b {CORE.timing['next_frame_to_first_result_clocks']} clocks"]
