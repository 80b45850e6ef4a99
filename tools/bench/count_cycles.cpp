// Runs board_program on a simulated Mega and counts the exact cycles between its marks. The last
// line is JSON: {"name": [median, maximum], ...}
#include <simavr/sim_io.h>

#include <cstdio>

#include "cases.h"
#include "mega/virtual_board.h"

namespace {

const avr_io_addr_t kMarkRegister = 0x3E;  // GPIOR0 in the data space

struct Clock {
  int running = 0;
  avr_cycle_count_t started = 0;
  bool finished = false;
  std::vector<avr_cycle_count_t> cycles[bench::kCaseCount];
};

void onMark(avr_t* avr, avr_io_addr_t address, uint8_t mark, void* parameter) {
  Clock& clock = *static_cast<Clock*>(parameter);
  avr->data[address] = mark;
  clock.finished = mark == bench::kFinished;
  if (mark == 0 && clock.running != 0)
    clock.cycles[clock.running - 1].push_back(avr->cycle - clock.started);
  clock.running = mark;
  clock.started = avr->cycle;
}

void print(Clock& clock) {
  // The cost of two marks with nothing between them is subtracted.
  const avr_cycle_count_t marks = clock.cycles[0][0];
  std::printf("{");
  for (int i = 1; i < bench::kCaseCount; ++i) {
    std::vector<avr_cycle_count_t>& all = clock.cycles[i];
    std::sort(all.begin(), all.end());
    std::printf("%s\"%s\": [%llu, %llu]", i > 1 ? ", " : "", bench::kCases[i].name,
                (unsigned long long)((all[all.size() / 2] - marks)),
                (unsigned long long)((all.back() - marks)));
  }
  std::printf("}\n");
}

}  // namespace

int main(int, char** arguments) try {
  vm::VirtualBoard board(arguments[1]);
  Clock clock;
  avr_register_io_write(board.avr(), kMarkRegister, onMark, &clock);
  while (!clock.finished) board.runMs(1);
  print(clock);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "count_cycles: %s\n", error.what());
  return 1;
}
