// Where the sled is: found, reported, lost, and followed at rest.
#include <cmath>
#include <tuple>

#include "parts.h"

using namespace machine;

namespace {

struct PlaceAlone : PartsAtRest {};

TEST_F(PlaceAlone, IsUnknownIfTheChainsFitNoPlace) {
  const auto isPlaceKept = [&] {
    for (int i = 0; i < 1000; ++i) {
      waiting.pass();
      place.keepWhenAtRest(board.now_ms);
    }
    return settings::Memory(eeprom, values).start().position.has_place;
  };
  axes.simulate(false);
  EXPECT_TRUE(isPlaceKept());
  axes.declare(kLeftAxis, 100);
  axes.declare(kRightAxis, 100);
  keeper.declareChains();
  EXPECT_FALSE(isPlaceKept());
}

TEST_F(PlaceAlone, IsSearchedAgainAfterAChainIsPulled) {
  axes.simulate(false);
  waiting.in_each_round = [&] { place.keepWhenAtRest(board.now_ms); };
  waiting.waitFor(1000);
  for (const auto& [counts, least, most] :
       {std::tuple<int, float, float>{45, 0, 0}, {128, 0.3f, 2}}) {
    place.search(Search::kHalted);
    const Place before = program.aim();
    board.counted[kLeftAxis] = uint16_t(board.counted[kLeftAxis] + counts);
    waiting.waitFor(1000);
    const float moved = float(std::hypot(program.aim().x - before.x, program.aim().y - before.y));
    EXPECT_GE(moved, least) << counts;
    EXPECT_LE(moved, most) << counts;
  }
}

}  // namespace
