[[ bench.banner ]]
// Drives the core with vectors/stimulus.hex, with random pauses on the input and random stops on the output, and compares
// every stage with vectors/*.hex. Run it from the folder that holds vectors/.
//   +seed=N        seed of pauses and stops (1)
//   +pause=P       percent of clocks without input (25)
//   +stop=P        percent of clocks without output (25)
//   built with --coverage: leaves coverage.dat
//   +dump=FILE     waveform (where built with --trace-fst), from clock +dump_from=C to +dump_to=C
// The last line is `PASS values=… clocks=…` or `FAIL mismatches=…`.
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "Vbench_taps.h"
#include "verilated.h"
#if VM_TRACE
#include "verilated_fst_c.h"
#endif
#if VM_COVERAGE
#include "verilated_cov.h"
#endif

namespace {

constexpr size_t kRecords = [[ bench.records ]];
constexpr size_t kStimulus = [[ bench.stimulus ]];
constexpr size_t kEpochs = [[ bench.epochs ]];
constexpr size_t kRests = [[ bench.rests ]];
constexpr size_t kPixels = [[ bench.pixels ]];
constexpr size_t kWidth = [[ bench.width ]];
constexpr uint64_t kSilence = [[ bench.silence ]];  // longest pause inside a frame, clocks
constexpr uint64_t kPatience = 20000 + 8 * kPixels + 4 * kSilence;  // clocks without any result that end the run
constexpr uint64_t kLimit = 10;  // mismatches that are printed
constexpr int kStages = [[ bench.stage_count ]];

const char* const kVectors[] = {
[%- for vector in bench.vectors %]
    "[[ vector.name ]]",
[%- endfor %]
};

struct Channel {
  const char* name;
  int stage;   // stage at which it is compared
  int vector;  // file of its golden values
  int bits;    // width
};

constexpr Channel kChannels[] = {
[%- for stage in bench.stages %]
[%- for channel in stage.channels %]
    {"[[ channel.name ]]", [[ channel.stage ]], [[ channel.vector_number ]], [[ channel.bits ]]},
[%- endfor %]
[%- endfor %]
};
constexpr int kChannelCount = sizeof kChannels / sizeof *kChannels;

// One hexadecimal word a line; comment lines begin with a slash.
std::vector<uint64_t> read_hex(const std::string& name, size_t count) {
  const std::string path = "vectors/" + name + ".hex";
  std::ifstream file(path);
  std::vector<uint64_t> values;
  values.reserve(count);
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '/') continue;
    values.push_back(std::strtoull(line.c_str(), nullptr, 16));
  }
  if (values.size() != count) {
    std::printf("BROKEN %s: %zu values, expected %zu\n", path.c_str(), values.size(), count);
    std::exit(2);
  }
  return values;
}

uint64_t plusarg(int argc, char** argv, const char* name, uint64_t otherwise) {
  const std::string prefix = std::string("+") + name + "=";
  for (int i = 1; i < argc; i++) {
    if (std::strncmp(argv[i], prefix.c_str(), prefix.size()) == 0) return std::strtoull(argv[i] + prefix.size(), nullptr, 10);
  }
  return otherwise;
}

// xorshift64*: the same pauses for the same seed on every machine.
struct Random {
  uint64_t state;
  uint64_t next() {
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    return state * UINT64_C(2685821657736338717) >> 33;
  }
  bool percent(uint64_t p) { return next() % 100 < p; }
};

std::string binary(uint64_t value, int bits) {
  std::string text;
  for (int bit = bits - 1; bit >= 0; bit--) text += value >> bit & 1 ? '1' : '0';
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  const auto context = std::make_unique<VerilatedContext>();
  context->commandArgs(argc, argv);
  // Registers without reset start with random bits: nothing may depend on them.
  context->randReset(2);
  context->randSeed(static_cast<int>(plusarg(argc, argv, "seed", 1)));
  const auto top = std::make_unique<Vbench_taps>(context.get());

  const uint64_t pause = plusarg(argc, argv, "pause", 25);
  const uint64_t stop = plusarg(argc, argv, "stop", 25);
  Random random{plusarg(argc, argv, "seed", 1) * UINT64_C(0x9E3779B97F4A7C15) + 1};

  const std::vector<uint64_t> stimulus = read_hex("stimulus", kStimulus);
  const std::vector<uint64_t> epoch_end = read_hex("epochs", kEpochs);
  const std::vector<uint64_t> rests = read_hex("rests", 3 * kRests);  // results due, sets done, sets discarded
  std::vector<std::vector<uint64_t>> expected;
  for (const char* name : kVectors) expected.push_back(read_hex(name, kRecords));

#if VM_TRACE
  const uint64_t dump_from = plusarg(argc, argv, "dump_from", 0);
  const uint64_t dump_to = plusarg(argc, argv, "dump_to", UINT64_MAX);
  std::unique_ptr<VerilatedFstC> trace;
  for (int i = 1; i < argc; i++) {
    if (std::strncmp(argv[i], "+dump=", 6) == 0) {
      context->traceEverOn(true);
      trace = std::make_unique<VerilatedFstC>();
      top->trace(trace.get(), 99);
      trace->open(argv[i] + 6);
    }
  }
#endif

  uint64_t clocks = 0, idle = 0, compared = 0, mismatches = 0, wait_for = 4, run = 0;
  uint64_t stalls = 0, all_stalls = 0, burst = 0;
  size_t word = 0, epoch = 0, rest = 0;
  size_t record[kStages] = {};
  uint64_t first_clock[kStages] = {};
  bool resetting = true, resting = false, exact = false, stopped = false, held_valid = false;
  std::vector<uint32_t> held, shown;

  auto complain = [&]() { return ++mismatches <= kLimit; };

  top->rst_ni = 0;
  top->s_axis_tvalid = 0;
  top->m_axis_tready = 0;
  for (;;) {
    // Before the edge: what the core shows, with the inputs as they stand.
    top->clk_i = 0;
    top->eval();
#if VM_TRACE
    if (trace && clocks >= dump_from && clocks <= dump_to) trace->dump(clocks * 10);
#endif
    clocks++;
    idle++;
    const bool taken = top->s_axis_tvalid && top->s_axis_tready;
    if (taken) idle = 0;
    if (!top->rst_ni) stalls = 0;
    else if (top->s_axis_tvalid && !taken) stalls++, all_stalls++;

    shown.assign(1, top->m_axis_tvalid | top->m_axis_tuser << 1 | top->m_axis_tlast << 2);
    shown.insert(shown.end(), reinterpret_cast<const uint32_t*>(&top->m_axis_tdata),
                 reinterpret_cast<const uint32_t*>(&top->m_axis_tdata) + sizeof top->m_axis_tdata / 4);
    if (held_valid && top->rst_ni && shown != held && complain()) {
      std::printf("UNSTABLE clock=%" PRIu64 ": the result changed while it waited\n", clocks);
    }
    held_valid = top->m_axis_tvalid && !top->m_axis_tready && top->rst_ni;
    held = shown;

    for (int stage = 0; top->rst_ni && stage < kStages; stage++) {
      if (!(top->strobe_o >> stage & 1)) continue;
      idle = 0;
      const size_t r = record[stage];
      if (first_clock[stage] == 0) first_clock[stage] = clocks;
      if (r >= epoch_end[epoch]) {
        if (complain()) std::printf("SURPLUS stage=%d record=%zu clock=%" PRIu64 "\n", stage, r, clocks);
      } else {
        auto check = [&](const char* name, int bits, uint64_t wanted, uint64_t found) {
          compared++;
          if (wanted == found || !complain()) return;
          std::printf("MISMATCH channel=%s record=%zu set=%zu pixel=%zu clock=%" PRIu64 " expected=%" PRIx64 " actual=%" PRIx64
                      " (binary %s, %s)\n",
                      name, r, r / kPixels, r % kPixels, clocks, wanted, found, binary(wanted, bits).c_str(),
                      binary(found, bits).c_str());
        };
        for (int c = 0; c < kChannelCount; c++) {
          const Channel& channel = kChannels[c];
          if (channel.stage != stage) continue;
          const uint64_t found = static_cast<uint64_t>(top->values_o[2 * c + 1]) << 32 | top->values_o[2 * c];
          check(channel.name, channel.bits, expected[channel.vector][r], found);
        }
        if (stage == kStages - 1) {
          check("output.first", 1, r % kPixels == 0, top->m_axis_tuser);
          check("output.last", 1, r % kPixels % kWidth == kWidth - 1, top->m_axis_tlast);
          if (top->padding_o) check("output.padding", 1, 0, 1);
        }
      }
      record[stage]++;
    }

    if (resting && idle > kSilence + 64 && record[kStages - 1] >= rests[3 * rest]) {
      resting = false;
      if ((top->sets_done_o != rests[3 * rest + 1] || top->sets_discarded_o != rests[3 * rest + 2] ||
           top->stall_clocks_o != stalls) &&
          complain()) {
        std::printf("COUNTERS sets_done=%u expected=%" PRIu64 " sets_discarded=%u expected=%" PRIu64
                    " stall_clocks=%u expected=%" PRIu64 " clock=%" PRIu64 "\n",
                    top->sets_done_o, rests[3 * rest + 1], top->sets_discarded_o, rests[3 * rest + 2],
                    top->stall_clocks_o, stalls, clocks);
      }
      compared += 3;
      rest++;
    }
    if ((word == kStimulus && wait_for == 0 && !resting) || idle > kPatience || mismatches > kLimit) break;

    // The inputs for the time after the edge, decided from what was seen before it.
    bool valid = top->s_axis_tvalid && !taken, reset_n = top->rst_ni;
    uint64_t beat = 0;
    bool offer = false;
    if (wait_for > 0) {
      wait_for--;
      if (wait_for == 0 && resetting) {
        reset_n = true;
        resetting = false;
      }
    } else if (!resting && !valid && word < kStimulus) {
      // An operation begins when the beat before it has been taken.
      const uint64_t next = stimulus[word];
      if (next >> 16 == 0x9) {  // a pause of exactly so many clocks
        word++;
        wait_for = (next & 0xffff) - 1;
        exact = true;
      } else if (next >> 16 == 0xa) {  // reset: what is still under way is lost
        word++;
        wait_for = 1 + random.next() % 4;
        resetting = true;
        reset_n = false;
        for (int stage = 0; stage < kStages; stage++) {
          if (record[stage] > epoch_end[epoch] && complain()) {
            std::printf("SURPLUS stage=%d record=%zu clock=%" PRIu64 "\n", stage, record[stage], clocks);
          }
          record[stage] = epoch_end[epoch];
        }
        epoch++;
      } else if (next >> 16 == 0xb) {  // rest: everything comes out
        word++;
        resting = true;
      } else if (!exact && run < 12 && random.percent(pause)) {
        run++;
      } else {
        run = 0;
        exact = false;
        word++;
        offer = valid = true;
        beat = next;
      }
    }
    // Stops come in bursts, so that a drain can fall behind by a whole line.
    if (burst == 0) {
      stopped = random.percent(stop);
      burst = 1 + random.next() % 8;
    }
    burst--;

    top->clk_i = 1;
    top->eval();
#if VM_TRACE
    if (trace && clocks > dump_from && clocks <= dump_to) trace->dump(clocks * 10 - 5);
#endif
    top->rst_ni = reset_n;
    top->s_axis_tvalid = valid;
    top->m_axis_tready = !stopped;
    if (offer) {
      top->s_axis_tdata = beat & 0xffff;
      top->s_axis_tlast = beat >> 18 & 1;
      top->s_axis_tuser = beat >> 16 & 3;
    }
  }
#if VM_TRACE
  if (trace) trace->close();
#endif
  top->final();
#if VM_COVERAGE
  context->coveragep()->write("coverage.dat");
#endif

  for (int stage = 0; stage < kStages; stage++) {
    if (record[stage] >= kRecords) continue;
    mismatches++;
    std::printf("MISSING stage=%d record=%zu of %zu clock=%" PRIu64 "\n", stage, record[stage], kRecords, clocks);
  }
  if (word != kStimulus) {
    mismatches++;
    std::printf("STUCK stimulus=%zu of %zu clock=%" PRIu64 ": the input was not taken\n", word, kStimulus, clocks);
  }
  std::printf("STALLED clocks=%" PRIu64 "\n", all_stalls);
  std::printf("FIRST clock of each stage:");
  for (uint64_t clock : first_clock) std::printf(" %" PRIu64, clock);
  std::printf("\n");
  if (mismatches == 0) std::printf("PASS values=%" PRIu64 " clocks=%" PRIu64 "\n", compared, clocks);
  else std::printf("FAIL mismatches=%" PRIu64 " clocks=%" PRIu64 "\n", mismatches, clocks);
  return mismatches == 0 ? 0 : 1;
}
