// Where the sled is: looked for, said or not, lost, and followed at rest.
#include <cmath>
#include <tuple>

#include "parts.h"

using namespace machine;

namespace {

struct PlaceAlone : PartsAtRest {};

TEST_F(PlaceAlone, IsNoneWithoutTrustAndSaysWhy) {
  EXPECT_TRUE(place.isKnown());
  place.lose(settings::Doubt::kSimulated);
  EXPECT_FALSE(place.isKnown() || keeper.trustsChains());
  expectSaid(
      "ALARM: Position Lost. Motion was simulated, so the chains are elsewhere. Last known chain "
      "lengths: ");
  EXPECT_TRUE(place.search(Search::kHalted));
  EXPECT_FALSE(place.isKnown());
  keeper.declareChains();
  EXPECT_TRUE(place.search(Search::kDeclared));
  EXPECT_TRUE(place.isKnown());
  expectSaid("position loaded at:\r\n0.00\r\n0.00\r\n");
}

TEST_F(PlaceAlone, IsKeptAsNoneWhereTheChainsPutTheSledNowhere) {
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

TEST_F(PlaceAlone, BringsAimAndCountTogetherWhenItIsLookedFor) {
  program.countFrom(50, 60);
  EXPECT_TRUE(program.isCountedBeyond());
  place.search(Search::kHalted);
  EXPECT_FALSE(program.isCountedBeyond());
  EXPECT_NEAR(0, program.counted().x, 0.01);
  place.declareZ(3);
  EXPECT_FLOAT_EQ(3, program.aim().z);
  EXPECT_FLOAT_EQ(3, program.counted().z);
}

TEST_F(PlaceAlone, IsFollowedInMotionAndIsTheAimAtRest) {
  EXPECT_TRUE(moves.move(0, words("G0 X30")));
  waiting.waitFor(1000);
  const float middle = place.now(true).x;
  EXPECT_GT(middle, 3);
  EXPECT_LT(middle, 27);
  EXPECT_FLOAT_EQ(30, place.now(false).x);
}

TEST_F(PlaceAlone, IsLookedForWhereAChainWasPulledAtRest) {
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

TEST_F(PlaceAlone, NothingIsOnItsWayOnceItIsLost) {
  EXPECT_TRUE(moves.move(0, words("G0 X30")));
  waiting.waitFor(300);
  axes.simulate(false);
  EXPECT_FALSE(axes.isEmpty());
  place.lose(settings::Doubt::kSimulated);
  EXPECT_TRUE(axes.isEmpty());
  EXPECT_NEAR(0, place.farthestOff(), 0.001);
}

TEST_F(PlaceAlone, IsSaidWhereSomebodyAskedForItOrBroughtTheChainsThere) {
  const Search said[] = {Search::kStart, Search::kDeclared, Search::kCentred, Search::kStopped,
                         Search::kNewSettings};
  for (const Search why : said) {
    board.said.clear();
    EXPECT_TRUE(place.search(why));
    EXPECT_EQ("[Forward Calculating Position]\r\nposition loaded at:\r\n0.00\r\n0.00\r\n",
              board.said)
        << int(why);
  }
}

TEST_F(PlaceAlone, IsLookedForWithoutAWordElsewhere) {
  const Search quiet[] = {Search::kBeforeLine, Search::kHalted, Search::kErased,
                          Search::kChainsDriven, Search::kPulled};
  board.said.clear();
  for (const Search why : quiet) EXPECT_TRUE(place.search(why));
  EXPECT_EQ("", board.said);
}

TEST_F(PlaceAlone, IsNotSaidWhileTheChainsAreNotTrusted) {
  place.lose(settings::Doubt::kSimulated);
  board.said.clear();
  place.search(Search::kStopped);
  EXPECT_EQ("", board.said);
  EXPECT_EQ(Whereabouts::kLost, place.whereabouts());
}

TEST_F(PlaceAlone, IsNowhereWhereNoSledHangsOnTheChains) {
  axes.declare(kLeftAxis, 100);
  axes.declare(kRightAxis, 100);
  board.said.clear();
  EXPECT_FALSE(place.search(Search::kDeclared));
  EXPECT_EQ(Whereabouts::kNowhere, place.whereabouts());
  EXPECT_FALSE(place.isKnown());
  expectSaid("Unable to find valid machine position for chain lengths 100.00, 100.00 .");
  out.line(place.whatIsLost());
  expectSaid("the chains put the sled nowhere: set their lengths first");
  hangAt(0, 0);
  EXPECT_EQ(Whereabouts::kFound, place.whereabouts());
}

TEST_F(PlaceAlone, BelongsWhereItIsSaidToBe) {
  axes.simulate(false);
  waiting.in_each_round = [&] { place.keepWhenAtRest(board.now_ms); };
  waiting.waitFor(1000);
  board.counted[kLeftAxis] = uint16_t(board.counted[kLeftAxis] + 1280);
  waiting.waitFor(1000);
  const float moved = place.movedBy();
  EXPECT_GT(moved, 2);
  place.search(Search::kHalted);
  EXPECT_FLOAT_EQ(moved, place.movedBy()) << "nobody has said that it belongs there";
  place.search(Search::kStopped);
  EXPECT_FLOAT_EQ(0, place.movedBy());
}

TEST_F(PlaceAlone, IsSaidToHaveMovedByTheWayFromWhereItWasLeft) {
  hangAt(300, 200);
  axes.simulate(false);
  waiting.in_each_round = [&] { place.keepWhenAtRest(board.now_ms); };
  waiting.waitFor(1000);
  const Place left = program.aim();
  board.counted[kLeftAxis] = uint16_t(board.counted[kLeftAxis] + 1280);
  waiting.waitFor(1000);
  const Place is = program.aim();
  EXPECT_GT(place.movedBy(), 2);
  EXPECT_NEAR(std::hypot(is.x - left.x, is.y - left.y), place.movedBy(), 0.01);
}

TEST_F(PlaceAlone, StandsWhereItWasFoundAtTheHeightOfNow) {
  EXPECT_TRUE(moves.move(0, words("G0 X30 Z1")));
  EXPECT_FLOAT_EQ(30, program.aim().x) << "before the sled is there";
  program.countFrom(50, 60);
  EXPECT_TRUE(program.isCountedBeyond());
  program.countFromAim();
  EXPECT_FLOAT_EQ(30, program.counted().x);
  EXPECT_TRUE(waiting.drain());
  axes.declare(kZAxis, 4);
  place.standHere();
  EXPECT_NEAR(4, program.aim().z, 0.01);
}

}  // namespace
