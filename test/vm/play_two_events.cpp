// Any two events at once, on the flashed program: `play_two_events ELF FIRST PLACE...` plays the
// event FIRST with each other event. The places are addresses in the Mega's RAM, in the order of
// ram_places.cpp. Exit code 0: the law held, 1: it was broken, 2: a pair could not be played.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>

#include "mega_player.h"
#include "test_dialogues/two_events.h"

using namespace two_events;
using machine::kAxisCount;

namespace {

/// Addresses in the RAM; those of an axis are those of the left axis.
struct Places {
  uint16_t built, state, lost, axis_size, mode, set_point, counts, mm_per_count;
};

/// The machine in the RAM of the simulated Mega.
class Ram {
 public:
  Ram(brain::MegaBrain& mega, const Places& places) : mega_(mega), places_(places) {}

  /// Whether setup() has built the machine.
  bool isBuilt() const { return read<uint8_t>(places_.built) != 0; }

  Seen seen() const {
    Seen seen = {machine::State(read<uint8_t>(places_.state)),
                 false,
                 read<uint8_t>(places_.lost) == 0,
                 {},
                 {}};
    for (int i = 0; i < kAxisCount; ++i) {
      const uint16_t axis = uint16_t(i * places_.axis_size);
      const auto mode = machine::AxisMode(read<uint8_t>(uint16_t(places_.mode + axis)));
      seen.is_powered = seen.is_powered || mode != machine::AxisMode::kOff;
      seen.targets[i] = motion::toMm<float>(read<int32_t>(uint16_t(places_.set_point + axis)));
      seen.lengths[i] = float(read<int32_t>(uint16_t(places_.counts + axis))) *
                        read<float>(uint16_t(places_.mm_per_count + axis));
    }
    return seen;
  }

 private:
  template <class Value>
  Value read(uint16_t address) const {
    Value value;
    std::memcpy(&value, mega_.board().avr()->data + address, sizeof value);
    return value;
  }

  brain::MegaBrain& mega_;
  const Places& places_;
};

/// Plays a pair in a scene; whether the law held.
bool play(const char* elf, const Places& places, int scene, int first, int second,
          std::mt19937& random, int& times_still, int& times_place) {
  world::World world(partsOfDialogues(), 1651);
  brain::MegaBrain mega(world, elf);
  vm::MegaPlayer player(stepsOf(scene, first, second, random), world, mega);
  const Ram ram(mega, places);
  Law law(player, world);
  player.look = [&] {
    if (ram.isBuilt()) law.look(ram.seen());
  };
  std::string wrong;
  try {
    player.play();
    wrong = law.broken();
  } catch (const Failure& failure) {
    wrong = failure.what();
  }
  times_still += law.timesStill();
  times_place += law.timesPlace();
  if (!wrong.empty())
    std::fprintf(stderr, "scene %d: %s then %s: %s\n", scene, nameOf(first).c_str(),
                 nameOf(second).c_str(), wrong.c_str());
  return wrong.empty();
}

}  // namespace

int main(int argc, char** argv) {
  const int kPlaces = sizeof(Places) / sizeof(uint16_t);
  uint16_t given[kPlaces];
  if (argc != 3 + kPlaces) {
    std::fprintf(stderr, "play_two_events: give ELF FIRST and %d places\n", kPlaces);
    return 2;
  }
  for (int i = 0; i < kPlaces; ++i) given[i] = uint16_t(std::atoi(argv[3 + i]));
  Places places;
  std::memcpy(&places, given, sizeof places);
  try {
    const int first = std::atoi(argv[2]);
    std::mt19937 random(unsigned(97 + first));
    bool holds = true;
    int times_still = 0, times_place = 0;
    for (int second = 0; second < kEventCount; ++second) {
      const int scene = int(random() % unsigned(kSceneCount));
      holds =
          play(argv[1], places, scene, first, second, random, times_still, times_place) && holds;
    }
    std::printf("still %d\nplace %d\n", times_still, times_place);
    return holds ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "play_two_events: %s\n", error.what());
    return 2;
  }
}
