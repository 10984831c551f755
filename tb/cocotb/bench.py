"""The core's ports, clock by clock: AXI4-Stream in and out with random pauses and back-pressure, and its rules checked."""

import random
from collections import namedtuple

from cocotb.clock import Clock
from cocotb.triggers import FallingEdge

Beat = namedtuple("Beat", "code last user")
Shown = namedtuple("Shown", "s_ready m_valid m_data m_last m_user")


def beats_of(core, codes):
    """One set's codes, [raw frame, pixel], as beats."""
    return [
        Beat(int(code), (pixel + 1) % core.width == 0, (pixel == 0) | (pixel == 0 and frame == 0) << 1)
        for frame, row in enumerate(codes)
        for pixel, code in enumerate(row)
    ]


class Bench:
    """Drives and reads in the middle of every clock: the core's outputs are registers, so what stands there then stands at the
    next rising edge too, in every simulator."""

    def __init__(self, dut, core, seed=1, pause=0.25, stop=0.25):
        self.dut, self.core = dut, core
        self.random, self.pause, self.stop = random.Random(seed), pause, stop
        self.stopped, self.burst = False, 0
        self.held = None
        self.results = []

    async def start(self):
        """Clock and reset; checks what explanation.json promises of every output in reset."""
        dut = self.dut
        dut.rst_ni.value = 0
        for port in self.core.numbers["ports"]:
            handle = getattr(dut, port["name"])
            assert len(handle) == port["bits"], f"{port['name']} has {len(handle)} bits"
            if port["direction"] == "input" and port["name"] not in ("clk_i", "rst_ni"):
                handle.value = 0
        Clock(dut.clk_i, 10, unit="ns").start()
        for clock in range(4):
            await FallingEdge(dut.clk_i)
            if clock > 0:
                self.check_reset()
        dut.rst_ni.value = 1
        await FallingEdge(dut.clk_i)
        self.check_reset()

    def check_reset(self):
        for port in self.core.numbers["ports"]:
            if port["at_reset"] is not None:
                found = int(getattr(self.dut, port["name"]).value)
                assert found == port["at_reset"], f"{port['name']} is {found} in reset"

    async def clock(self, beat, ready):
        """One clock with `beat` offered (or none) and the sink ready or not: what the core shows, a result that is taken put aside."""
        dut = self.dut
        await FallingEdge(dut.clk_i)
        valid = int(dut.m_axis_tvalid.value)
        payload = [int(signal.value) if valid else None for signal in (dut.m_axis_tdata, dut.m_axis_tlast, dut.m_axis_tuser)]
        shown = Shown(int(dut.s_axis_tready.value), valid, *payload)
        if self.held is not None:
            assert shown[1:] == self.held[1:], f"a result that waits has changed: {self.held} to {shown}"
        self.held = shown if valid and not ready else None
        if valid and ready:
            self.results.append(payload)
        dut.m_axis_tready.value = int(ready)
        dut.s_axis_tvalid.value = int(beat is not None)
        if beat is not None:
            dut.s_axis_tdata.value = beat.code
            dut.s_axis_tlast.value = int(beat.last)
            dut.s_axis_tuser.value = int(beat.user)
        return shown

    def ready(self):
        """Stops come in bursts, so that results fall behind."""
        if self.burst == 0:
            self.stopped, self.burst = self.random.random() < self.stop, self.random.randint(1, 8)
        self.burst -= 1
        return not self.stopped

    async def send(self, beats):
        """Sends `beats`; an offer stays until it is taken."""
        for beat in beats:
            while self.random.random() < self.pause:
                await self.clock(None, self.ready())
            waited = 0
            while not (await self.clock(beat, self.ready())).s_ready:
                waited += 1
                assert waited < 100 * self.core.pixels, "the core takes nothing any more"

    async def rest(self):
        """Waits until everything that is due must have come out."""
        timing = self.core.timing
        quiet, due = 0, timing["silence_to_first_result_clocks"] + timing["most_shifts"] + timing["clocks_a_burst"] + 32
        while quiet < due:
            quiet = 0 if (await self.clock(None, self.ready())).m_valid else quiet + 1

    def sets(self):
        """The result words of every set that has come out, their markers checked."""
        core = self.core
        assert len(self.results) % core.pixels == 0, f"{len(self.results)} results, {core.pixels} a set"
        for number, (_, last, user) in enumerate(self.results):
            pixel = number % core.pixels
            assert user == (pixel == 0), f"tuser of result {number} is {user}"
            assert last == ((pixel + 1) % core.width == 0), f"tlast of result {number} is {last}"
        words = [word for word, _, _ in self.results]
        return [words[start : start + core.pixels] for start in range(0, len(words), core.pixels)]

    def counters(self):
        return int(self.dut.sets_done_o.value), int(self.dut.sets_discarded_o.value)
