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
constexpr size_t kAnnouncements = [[ bench.announcements ]];
constexpr size_t kAnnouncementLines = [[ bench.announcement_lines ]];  // of the file, which is never empty
constexpr uint64_t kFirstAnnouncement = [[ bench.first_announcement_value ]];  // {first of a set, phase step, its phase}
constexpr size_t kAccesses = [[ bench.accesses ]];
[%- if bench.registers %]
constexpr size_t kAccessLines = [[ bench.access_lines ]];
constexpr uint32_t kFrequencyFactor = [[ bench.frequency_factor_value ]];  // after a reset
[%- endif %]
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

[% if bench.registers -%]
// What the core has counted since reset, as the bench knows it, before the present clock's edge.
struct Counted {
  uint64_t stalls = 0, saturated_pixels = 0, set_number = 0;
};

// A processor that accesses the registers, at random times, and checks every answer.
struct Processor {
  Vbench_taps* top;
  const std::vector<uint64_t> accesses;  // {write, okay, counter, strobes, address}, written, read (or the factor then)
  Random random;
  uint64_t stop;  // percent of clocks in which no answer is taken
  size_t due = 0, issue = 0, answer = 0;  // accesses that have begun, next one offered, next one answered
  uint64_t a_wait = 0, w_wait = 0;
  bool issuing = false, aw_open = false, w_open = false, ar_open = false, b_held = false, r_held = false;
  bool aw_taken = false, w_taken = false, ar_taken = false;
  uint64_t b_was = 0, r_was = 0, counted[16] = {};
  uint32_t factor = kFrequencyFactor;

  uint64_t head(size_t access) const { return accesses[3 * access]; }

  template <class Complain>
  void answered(bool write, uint64_t response, uint64_t data, uint64_t clocks, uint64_t& compared, const Complain& complain) {
    if (answer >= issue || (head(answer) >> 17 & 1) != write) {
      if (complain()) std::printf("REGISTER access=%zu clock=%" PRIu64 ": an answer that is not due\n", answer, clocks);
      return;
    }
    const uint64_t h = head(answer), okay = h >> 16 & 1;
    const uint64_t wanted = h >> 12 & 15 ? counted[answer % 16] : accesses[3 * answer + 2];
    if ((response != (okay ? 0 : 2) || (!write && data != wanted)) && complain()) {
      std::printf("REGISTER access=%zu write=%d address=%" PRIx64 " clock=%" PRIu64 " expected=%" PRIx64 " okay=%" PRIu64
                  " actual=%" PRIx64 " response=%" PRIu64 "\n",
                  answer, write, h & 255, clocks, wanted, okay, data, response);
    }
    compared += write ? 1 : 2;
    answer++;
  }

  // Before the edge. True where something happened.
  template <class Complain>
  bool observe(const Counted& bench, uint64_t clocks, uint64_t& compared, const Complain& complain) {
    const size_t before = issue + answer;
    const uint64_t r = static_cast<uint64_t>(top->s_axil_rresp) << 32 | top->s_axil_rdata;
    if (!top->rst_ni) {
      factor = kFrequencyFactor;
    } else {
      if (top->s_axil_bvalid && !b_held && answer < issue) factor = static_cast<uint32_t>(accesses[3 * answer + 2]);
      if (top->frequency_factor_o != factor && complain()) {
        std::printf("REGISTER frequency_factor clock=%" PRIu64 " expected=%x actual=%x\n", clocks, factor,
                    top->frequency_factor_o);
      }
      if (((b_held && (!top->s_axil_bvalid || top->s_axil_bresp != b_was)) ||
           (r_held && (!top->s_axil_rvalid || r != r_was))) &&
          complain()) {
        std::printf("UNSTABLE clock=%" PRIu64 ": a register's answer changed while it waited\n", clocks);
      }
      if (top->s_axil_bvalid && top->s_axil_bready) answered(true, top->s_axil_bresp, 0, clocks, compared, complain);
      if (top->s_axil_rvalid && top->s_axil_rready) {
        answered(false, top->s_axil_rresp, top->s_axil_rdata, clocks, compared, complain);
      }
    }
    b_held = top->rst_ni && top->s_axil_bvalid && !top->s_axil_bready;
    b_was = top->s_axil_bresp;
    r_held = top->rst_ni && top->s_axil_rvalid && !top->s_axil_rready;
    r_was = r;
    aw_taken = top->s_axil_awvalid && top->s_axil_awready;
    w_taken = top->s_axil_wvalid && top->s_axil_wready;
    ar_taken = top->s_axil_arvalid && top->s_axil_arready;
    if (issuing) {
      if (aw_taken) aw_open = false;
      if (w_taken) w_open = false;
      if (ar_taken) {
        ar_open = false;
        const uint64_t values[] = {0, top->sets_done_o, top->sets_discarded_o, bench.stalls, bench.saturated_pixels,
                                   bench.set_number};
        const uint64_t counter = head(issue) >> 12 & 15;
        if (counter < sizeof values / sizeof *values) counted[issue % 16] = values[counter];
      }
      if (!aw_open && !w_open && !ar_open) {
        issuing = false;
        issue++;
      }
    }
    return issue + answer != before;
  }

  // A reset: what has begun is given up.
  void reset() {
    issuing = aw_open = w_open = ar_open = false;
    issue = answer = due;
  }

  // The inputs for the time after the edge.
  void drive() {
    bool aw_valid = top->s_axil_awvalid && !aw_taken, w_valid = top->s_axil_wvalid && !w_taken;
    bool ar_valid = top->s_axil_arvalid && !ar_taken;
    if (!issuing) aw_valid = w_valid = ar_valid = false;
    // Reads may follow reads, and writes writes, before they are answered.
    if (top->rst_ni && !issuing && issue < due && issue < answer + 8 &&
        (issue == answer || (head(issue) >> 17) == (head(issue - 1) >> 17))) {
      issuing = true;
      aw_open = w_open = head(issue) >> 17 & 1;
      ar_open = !aw_open;
      a_wait = random.percent(50) ? random.next() % 6 : 0;
      w_wait = random.percent(50) ? random.next() % 6 : 0;
    } else if (issuing) {
      if (a_wait > 0) {
        a_wait--;
      } else {
        aw_valid = aw_open;
        ar_valid = ar_open;
      }
      if (w_wait > 0) w_wait--;
      else w_valid = w_open;
    }
    // What is not valid is anything.
    top->s_axil_awaddr = aw_valid ? head(issue) & 255 : random.next() & 255;
    top->s_axil_araddr = ar_valid ? head(issue) & 255 : random.next() & 255;
    top->s_axil_wdata = w_valid ? accesses[3 * issue + 1] : random.next();
    top->s_axil_wstrb = w_valid ? head(issue) >> 8 & 15 : random.next() & 15;
    top->s_axil_awvalid = aw_valid;
    top->s_axil_wvalid = w_valid;
    top->s_axil_arvalid = ar_valid;
    // Every other answer is waited for, not made ready for: a core that waits for readiness waits for ever.
    const bool shy = answer % 2;
    top->s_axil_bready = !random.percent(stop) && (!shy || top->s_axil_bvalid);
    top->s_axil_rready = !random.percent(stop) && (!shy || top->s_axil_rvalid);
  }
};

[% endif -%]
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
  // A source of its own, so that it leaves the pauses and stops as they are.
  Random noise{random.state ^ 0x2545f491};

  const std::vector<uint64_t> stimulus = read_hex("stimulus", kStimulus);
  const std::vector<uint64_t> epoch_end = read_hex("epochs", 2 * kEpochs);  // results and announcements due
  const std::vector<uint64_t> announcements = read_hex("announcements", kAnnouncementLines);
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
  uint64_t drained = 0, needless = 0;  // sums taken since reset; clocks for which a sample has been held without need
  uint64_t first_taken = UINT64_MAX;   // samples taken since the last start of set
  size_t word = 0, epoch = 0, rest = 0;
  size_t record[kStages] = {};
  uint64_t first_clock[kStages] = {};
  bool resetting = true, resting = false, exact = false, stopped = false, held_valid = false;
  std::vector<uint32_t> held, shown;
  size_t announcement = 0, saturated_vector = 0, due = 0, answer = 0;
  uint64_t announced = kFirstAnnouncement, saturated_pixels = 0, set_number = 0;
  while (std::strcmp(kVectors[saturated_vector], "saturated") != 0) saturated_vector++;
[%- if bench.registers %]
  // A source of its own: the stream's traffic stays what it is without accesses.
  Processor processor{top.get(), read_hex("accesses", 3 * kAccessLines), Random{random.state ^ 0x5bd1e995}, stop};
  top->s_axil_awvalid = top->s_axil_wvalid = top->s_axil_arvalid = 0;
  top->s_axil_bready = top->s_axil_rready = 0;
[%- endif %]

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
[%- if bench.registers %]
    if (processor.observe(Counted{stalls, saturated_pixels, set_number}, clocks, compared, complain)) idle = 0;
    due = processor.due;
    answer = processor.answer;
[%- endif %]
    if (!top->rst_ni) {
      announced = kFirstAnnouncement;
    } else {
      if (top->next_frame_strobe_o) {
        idle = 0;
        if (announcement >= epoch_end[2 * epoch + 1]) {
          if (complain()) std::printf("SEQUENCER announcement=%zu clock=%" PRIu64 ": it is not due\n", announcement, clocks);
        } else {
          announced = announcements[announcement++];
          compared++;
        }
      }
      if (top->next_frame_o != announced && complain()) {
        std::printf("SEQUENCER announcement=%zu clock=%" PRIu64 " {first, step, phase} expected=%s actual=%s\n",
                    announcement - 1, clocks, binary(announced, [[ bench.announcement_bits ]]).c_str(),
                    binary(top->next_frame_o, [[ bench.announcement_bits ]]).c_str());
      }
    }
    const bool taken = top->s_axis_tvalid && top->s_axis_tready;
    if (taken) idle = 0;
    if (!top->rst_ni) stalls = saturated_pixels = set_number = 0;
    else if (top->s_axis_tvalid && !taken) stalls++, all_stalls++;

    // A set's first frame may follow the drain of the set before: a sample of a pixel whose sums have been taken need not wait.
    // Two samples before it may be on their way; they must be the same frame's.
    // The last two sums may wait in registers after their drain, while the next set is complete already.
    const bool draining = drained % kPixels + 2 < kPixels && first_taken >= 2 && first_taken < drained % kPixels;
    needless = top->rst_ni && top->s_axis_tvalid && !taken && draining ? needless + 1 : 0;
    if (needless == 4 && complain()) std::printf("HELD clock=%" PRIu64 ": a sample whose pixel has drained waits\n", clocks);
    if (!top->rst_ni) drained = 0, first_taken = UINT64_MAX;
    else if (taken && (top->s_axis_tuser & 3) == 3) first_taken = 1;
    else if (taken && first_taken != UINT64_MAX) first_taken++;
    if (top->rst_ni) drained += top->strobe_o & 1;
    if (top->rst_ni && top->refused_o && complain()) {
      std::printf("REFUSED clock=%" PRIu64 ": an empty register holds up what comes before it\n", clocks);
    }

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
      if (r >= epoch_end[2 * epoch]) {
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
          saturated_pixels += expected[saturated_vector][r];
          set_number += r % kPixels == 0;
          if (top->padding_o) check("output.padding", 1, 0, 1);
        }
      }
      record[stage]++;
    }

    if (resting && answer == due && idle > kSilence + 64 && record[kStages - 1] >= rests[3 * rest]) {
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
    if ((word == kStimulus && wait_for == 0 && !resting && answer == due) || idle > kPatience || mismatches > kLimit) break;

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
          if (record[stage] > epoch_end[2 * epoch] && complain()) {
            std::printf("SURPLUS stage=%d record=%zu clock=%" PRIu64 "\n", stage, record[stage], clocks);
          }
          record[stage] = epoch_end[2 * epoch];
        }
        if (announcement > epoch_end[2 * epoch + 1] && complain()) {
          std::printf("SEQUENCER announcement=%zu clock=%" PRIu64 ": it is not due\n", announcement, clocks);
        }
        announcement = epoch_end[2 * epoch + 1];
        epoch++;
[%- if bench.registers %]
        processor.reset();
      } else if (next >> 16 == 0xc) {  // the next access to a register begins
        word++;
        processor.due++;
[%- endif %]
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
      // Once in a while one is so long that every register behind it fills up.
      if (stopped && random.next() % 96 == 0) burst = 256;
    }
    burst--;

    top->clk_i = 1;
    top->eval();
#if VM_TRACE
    if (trace && clocks > dump_from && clocks <= dump_to) trace->dump(clocks * 10 - 5);
#endif
[%- if bench.registers %]
    processor.drive();
[%- endif %]
    top->rst_ni = reset_n;
    top->s_axis_tvalid = valid;
    // While everything comes out, the sink is ready for nothing but what is offered: a core that waits for it waits for ever.
    const bool shy = resting || word == kStimulus;
    top->m_axis_tready = !stopped && (!shy || top->m_axis_tvalid);
    if (!valid) {
      // What is not valid is anything.
      top->s_axis_tdata = noise.next() & [[ bench.sample_mask ]];
      top->s_axis_tlast = noise.next() & 1;
      top->s_axis_tuser = noise.next() & [[ bench.user_mask ]];
    }
    if (offer) {
      top->s_axis_tdata = beat & 0xffff;
      top->s_axis_tlast = beat >> 18 & 1;
      top->s_axis_tuser = [% if bench.user_bits == 3 %](beat >> 20 & 1) << 2 | (beat >> 16 & 3)[% else %]beat >> 16 & 3[% endif %];
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
  if (announcement != kAnnouncements) {
    mismatches++;
    std::printf("SEQUENCER announcement=%zu of %zu clock=%" PRIu64 ": it is missing\n", announcement, kAnnouncements, clocks);
  }
  if (answer != due) {
    mismatches++;
    std::printf("REGISTER access=%zu of %zu clock=%" PRIu64 ": no answer\n", answer, kAccesses, clocks);
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
