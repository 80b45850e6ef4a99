// Runs board_program on a simulated Mega: per case, the exact cycles between
// marks and the deepest stack. The last line is JSON: {"name": {"cycles": [minimum, median,
// maximum], "stack": bytes}, ...}
#include <simavr/sim_avr.h>
#include <simavr/sim_elf.h>
#include <simavr/sim_io.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <vector>

#include "cases.h"

namespace {

// Places in the data space of the ATmega2560.
const avr_io_addr_t kMarkRegister = 0x3E;  // GPIOR0
const uint16_t kMemory = 0x200;            // first byte above the registers

// Only marks are noted, at their instruction.
const avr_cycle_count_t kMostAtOnce = 1000000;

const uint8_t kPaint =
    0xA5;  // fills the free memory before each call; a byte that differs was used

struct Clock {
  int running = 0;
  avr_cycle_count_t started = 0;
  bool finished = false;
  uint16_t stack_before = 0;
  int deepest[bench::kCaseCount] = {};
  std::vector<avr_cycle_count_t> cycles[bench::kCaseCount];
  uint16_t end_of_variables = kMemory;
};

uint16_t stackPointer(const avr_t* avr) {
  return uint16_t(avr->data[R_SPL] | avr->data[R_SPH] << 8);  // the next byte to be pushed
}

/// Paints the memory below the stack. The simulator does it, so it costs the board no cycles.
void paint(avr_t* avr, Clock& clock) {
  clock.stack_before = stackPointer(avr);
  std::memset(avr->data + clock.end_of_variables, kPaint,
              size_t(clock.stack_before + 1 - clock.end_of_variables));
}

int bytesUsed(const avr_t* avr, const Clock& clock) {
  uint16_t lowest = clock.end_of_variables;
  while (lowest <= clock.stack_before && avr->data[lowest] == kPaint) ++lowest;
  return clock.stack_before + 1 - lowest;
}

void onMark(avr_t* avr, avr_io_addr_t address, uint8_t mark, void* parameter) {
  Clock& clock = *static_cast<Clock*>(parameter);
  avr->data[address] = mark;
  if (mark == bench::kFinished) {
    clock.finished = true;
  } else if (mark != 0) {
    clock.running = mark;
    clock.started = avr->cycle;
    paint(avr, clock);
  } else if (clock.running != 0) {
    clock.cycles[clock.running - 1].push_back(avr->cycle - clock.started);
    int& deepest = clock.deepest[clock.running - 1];
    deepest = std::max(deepest, bytesUsed(avr, clock));
    clock.running = 0;
  }
}

void print(Clock& clock) {
  // The cost of two marks with nothing between them is subtracted.
  const avr_cycle_count_t marks = clock.cycles[0][0];
  std::printf("{");
  for (int i = 1; i < bench::kCaseCount; ++i) {
    std::vector<avr_cycle_count_t>& all = clock.cycles[i];
    std::sort(all.begin(), all.end());
    std::printf("%s\"%s\": {\"cycles\": [%llu, %llu, %llu], \"stack\": %d}", i > 1 ? ", " : "",
                bench::kCases[i].name, (unsigned long long)((all.front() - marks)),
                (unsigned long long)((all[all.size() / 2] - marks)),
                (unsigned long long)((all.back() - marks)), clock.deepest[i]);
  }
  std::printf("}\n");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "count_cycles: give the board program's ELF file\n");
    return 2;
  }
  elf_firmware_t firmware;
  std::memset(&firmware, 0, sizeof firmware);
  if (elf_read_firmware(argv[1], &firmware) != 0) {
    std::fprintf(stderr, "count_cycles: cannot read %s; build it with avr-g++\n", argv[1]);
    return 2;
  }
  avr_t* avr = avr_make_mcu_by_name("atmega2560");
  avr_init(avr);
  avr->frequency = 16000000;
  avr_load_firmware(avr, &firmware);
  Clock clock;
  clock.end_of_variables = uint16_t(kMemory + firmware.datasize + firmware.bsssize);
  avr_register_io_write(avr, kMarkRegister, onMark, &clock);
  avr->run_cycle_limit = kMostAtOnce;
  while (!clock.finished) {
    const int state = avr_run(avr);
    if (state == cpu_Done || state == cpu_Crashed) {
      std::fprintf(stderr, "count_cycles: the simulated board stopped before its last case\n");
      return 1;
    }
  }
  print(clock);
  return 0;
}
