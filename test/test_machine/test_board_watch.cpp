// The watch over supply, drivers and EEPROM: what it says, when, and how often.
#include <gtest/gtest.h>

#include "board_at_rest.h"
#include "machine/board_watch.h"

using namespace machine;

namespace {

/// A board with a supply and a driver that may report an error.
struct Board : BoardAtRest {
  bool driverFails(Axis axis) override { return complains && axis == kRightAxis; }
  uint16_t bandGap() override { return supply == 0 ? uint16_t(0) : uint16_t(1.1 * 1024 / supply); }

  double supply = 5;
  bool complains = false;
};

const BoardLimits kLimits = {1.1f, 4.3f};

/// How often each event came in `looks` looks.
struct Seen {
  int low = 0, fails = 0, worn = 0;
};

Seen seen(BoardWatch& watch, Board& board, int looks, bool is_powered = true,
          bool is_worn = false) {
  Seen seen;
  for (int i = 0; i < looks; ++i) {
    const BoardEvent event = watch.look(board, kLimits, is_powered, is_worn);
    seen.low += event == BoardEvent::kSupplyLow;
    seen.fails += event == BoardEvent::kDriverFails;
    seen.worn += event == BoardEvent::kWorn;
  }
  return seen;
}

}  // namespace

TEST(BoardWatch, ReportsNothingBeforeTheReferenceHasSettled) {
  BoardWatch watch;
  Board board;
  board.supply = 0;  // nothing measured yet
  EXPECT_EQ(0, seen(watch, board, 20).low);
  board.supply = 2;
  EXPECT_EQ(0, seen(watch, board, 7).low);
  board.supply = 5;
  EXPECT_EQ(0, seen(watch, board, 100).low);
  EXPECT_NEAR(5, watch.lowestSupply(), 0.03);
}

TEST(BoardWatch, ReportsADriverErrorAfterATenthOfASecond) {
  BoardWatch watch;
  Board board;
  board.complains = true;
  EXPECT_EQ(0, seen(watch, board, 4).fails);
  board.complains = false;
  EXPECT_EQ(0, seen(watch, board, 1).fails);
  board.complains = true;
  EXPECT_EQ(0, seen(watch, board, 4).fails);
  EXPECT_EQ(1, seen(watch, board, 1).fails);
  EXPECT_EQ(kRightAxis, watch.failing());
  EXPECT_EQ(0, seen(watch, board, 100, false).fails);
}

TEST(BoardWatch, ReportsAWornEepromOnce) {
  BoardWatch watch;
  Board board;
  EXPECT_EQ(0, seen(watch, board, 10).worn);
  EXPECT_EQ(1, seen(watch, board, 100, true, true).worn);
}
