// The position survives a power cut, wears out no cell, and a cut in motion is never overlooked.
#include <algorithm>

#include "boards.h"

namespace {

/// A ring of records alone in an EEPROM.
struct Ring {
  explicit Ring(Eeprom& eeprom, uint8_t slots = 65) : eeprom(eeprom), slots(eeprom, 2144, slots) {
    eeprom.restore();
    known = this->slots.load(position);
  }

  void settle() {
    for (int i = 0; slots.isBusy(); ++i) {
      ASSERT_LT(i, 100000);
      step();
    }
  }

  void step() {
    if (eeprom.ready()) slots.step();
  }

  Eeprom& eeprom;
  PositionSlots slots;
  Position position = {};
  Known known;
};

/// An EEPROM after several rests: at positionOf(0..count-1), moving in between.
Eeprom travelled(int count) {
  Eeprom eeprom;
  Ring ring(eeprom);
  for (int i = 0; i < count; ++i) {
    ring.slots.beginMoving();
    ring.settle();
    ring.slots.keep(positionOf(i));
    ring.settle();
  }
  return eeprom;
}

}  // namespace

TEST(Position, IsFoundAsItWasLeft) {
  for (int rests : {1, 2, 64, 65, 66, 131, 700}) {
    Eeprom eeprom = travelled(rests);
    Ring ring(eeprom);
    EXPECT_EQ(Known::kAtRest, ring.known);
    EXPECT_TRUE(same(positionOf(rests - 1), ring.position)) << rests;
    EXPECT_EQ(positionOf(0).scale, ring.position.scale);
    EXPECT_TRUE(ring.position.has_place);
  }
}

TEST(Position, IsFoundWhenItsNumberWrapsAround) {
  Eeprom eeprom;
  Ring ring(eeprom, 5);
  for (int i = 0; i < 65600; ++i) {
    ring.slots.keep(positionOf(i));
    ring.settle();
    if (i > 65500) {
      Ring again(eeprom, 5);
      ASSERT_TRUE(same(positionOf(i), again.position)) << i;
    }
  }
}

TEST(Position, ADoubtKeepsItsFirstReason) {
  for (const Doubt why : {Doubt::kMoving, Doubt::kScale, Doubt::kPlace, Doubt::kSimulated,
                          Doubt::kStack, Doubt::kCounts}) {
    Eeprom eeprom = travelled(3);
    {
      Ring ring(eeprom);
      ring.slots.doubt(why);
      ring.slots.doubt(Doubt::kPlace);
      ring.settle();
    }
    for (int start = 0; start < 3; ++start) {
      Ring ring(eeprom);
      ASSERT_EQ(Known::kDoubted, ring.known) << int(why);
      EXPECT_EQ(why, ring.slots.doubted());
      ring.slots.doubt(Doubt::kScale);
      ring.settle();
    }
    Ring ring(eeprom);
    ring.slots.keep(positionOf(4));
    ring.slots.doubt(Doubt::kStack);
    ring.settle();
    EXPECT_EQ(Doubt::kStack, Ring(eeprom).slots.doubted()) << "that reason is over";
  }
}

TEST(Position, ADoubtSurvivesMotionAndAHalfWrittenRecord) {
  for (int steps = 0; steps < 40; ++steps) {
    Eeprom eeprom = travelled(3);
    Ring ring(eeprom);
    ring.slots.beginMoving();
    ring.settle();
    ring.slots.keep(positionOf(9));
    for (int i = 0; i < steps; ++i) ring.step();
    ring.slots.doubt(Doubt::kCounts);
    ring.settle();
    ASSERT_EQ(Known::kDoubted, Ring(eeprom).known) << steps;
  }
}

TEST(Position, OfANewBoardCannotBeDoubted) {
  Eeprom eeprom;
  Ring ring(eeprom);
  ring.slots.doubt(Doubt::kCounts);
  ring.settle();
  EXPECT_EQ(0u, eeprom.writes);
  EXPECT_EQ(Known::kNothing, Ring(eeprom).known);
}

TEST(Position, IsForgottenBeforeMotionBegins) {
  for (int steps = 0; steps < 40; ++steps) {
    Eeprom eeprom = travelled(70);
    Ring ring(eeprom);
    ring.slots.forget();
    for (int i = 0; i < steps; ++i) ring.step();
    ring.slots.beginMoving();
    ring.settle();
    EXPECT_TRUE(ring.slots.mayMove());
    ASSERT_EQ(Known::kNothing, Ring(eeprom).known) << steps;
  }
}

TEST(Position, EveryCutLeavesTheOldOneInMotionOrTheNewOneAtRest) {
  std::mt19937 random(31);
  int cuts = 0;
  for (int rests : {1, 64, 65, 66, 200}) {
    Eeprom before = travelled(rests);
    {
      Ring ring(before);
      ring.slots.beginMoving();
      ring.settle();
    }
    for (int writes = 0; writes < PositionSlots::kBytesPerSlot; ++writes)
      for (int torn : tornBytes(random, 20)) {
        Eeprom eeprom = before;
        bool was_cut = false;
        try {
          Ring ring(eeprom);
          eeprom.cutAfter(writes, torn);
          ring.slots.keep(positionOf(rests));
          ring.settle();
        } catch (const PowerCut&) {
          was_cut = true;
          ++cuts;
        }
        Ring after(eeprom);
        const bool is_old =
            after.known == Known::kMoving && same(positionOf(rests - 1), after.position);
        const bool is_new =
            after.known == Known::kAtRest && same(positionOf(rests), after.position);
        ASSERT_TRUE(is_old || is_new) << rests << " rests, " << writes << " writes";
        ASSERT_TRUE(was_cut || is_new);
      }
  }
  std::printf("position: power cut %d times\n", cuts);
  testing::Test::RecordProperty("cuts", cuts);
  EXPECT_GT(cuts, 2500);
}

TEST(Position, IsNeverClaimedAtRestAfterItWasLeft) {
  // Anything may happen in any order, at any step of the writing; the machine moves whenever it
  // may. A record that says "at rest" must hold the machine's position.
  std::mt19937 random(32);
  int cuts = 0, at_rest = 0;
  Eeprom eeprom = travelled(67);
  int place = 66, last_place = 66;
  for (int life = 0; life < 20000; ++life) {
    Ring ring(eeprom);
    ASSERT_NE(Known::kNothing, ring.known);
    if (ring.known == Known::kAtRest) {
      ++at_rest;
      ASSERT_TRUE(same(positionOf(place), ring.position)) << "life " << life;
    }
    try {
      eeprom.cutAfter(int(random() % 150), int(random() & 0xFF));
      for (int act = 0; act < 12; ++act) {
        const bool moves = random() % 2;
        if (moves) ring.slots.beginMoving();
        for (unsigned steps = random() % 70; steps > 0; --steps) ring.step();
        if (moves && ring.slots.mayMove()) place = ++last_place;
        if (random() % 3) ring.slots.keep(positionOf(place));
      }
      ring.settle();
    } catch (const PowerCut&) {
      ++cuts;
    }
  }
  std::printf("position, any order: power cut %d times, %d starts at rest\n", cuts, at_rest);
  EXPECT_GT(cuts, 5000);
  EXPECT_GT(at_rest, 2000);
}

TEST(Position, WearsNoCellOutWithin30YearsOf300RestsADay) {
  Eeprom eeprom;
  Ring ring(eeprom);
  const int rests = 65 * 40;
  for (int i = 0; i < rests; ++i) {
    ring.slots.beginMoving();
    ring.settle();
    ring.slots.keep(positionOf(i));
    ring.settle();
  }
  const uint32_t most = *std::max_element(eeprom.worn.begin(), eeprom.worn.end());
  // Two writes of the mark in each of forty rounds.
  EXPECT_LE(most, 80u);
  EXPECT_EQ(0u, eeprom.needless_writes);
  const double rests_until_worn = 100000.0 * rests / most;
  std::printf(
      "position: a cell is written %u times in %d rests; %.1f million rests until 100,000\n", most,
      rests, rests_until_worn / 1e6);
  EXPECT_GT(rests_until_worn / 300 / 365, 29.6);
}

TEST(Position, WritesNothingIfNothingChanged) {
  Eeprom eeprom = travelled(3);
  Ring ring(eeprom);
  const uint32_t before = eeprom.writes;
  ring.slots.keep(positionOf(2));
  ring.settle();
  EXPECT_EQ(before, eeprom.writes);
  ring.slots.beginMoving();
  ring.settle();
  ring.slots.beginMoving();
  ring.settle();
  EXPECT_EQ(before + 1, eeprom.writes);
}

TEST(Position, IsKeptAgainWhileItsMarkIsWritten) {
  // G10 Z0 where z is 0: the place that is kept is the place of the record that is being marked.
  for (int steps = 0; steps < 4; ++steps) {
    for (bool doubted : {false, true}) {
      Eeprom eeprom = travelled(3);
      Ring ring(eeprom);
      if (doubted)
        ring.slots.doubt(Doubt::kCounts);
      else
        ring.slots.beginMoving();
      for (int i = 0; i < steps; ++i) ring.step();
      ring.slots.keep(positionOf(2));
      ring.settle();
      Ring after(eeprom);
      EXPECT_EQ(Known::kAtRest, after.known) << steps << " steps";
      EXPECT_TRUE(same(positionOf(2), after.position));
    }
  }
}

TEST(Position, PassesOverSlotsWithWornCells) {
  Eeprom eeprom;
  for (uint16_t slot : {1, 2, 7}) eeprom.dead[2144 + slot * 30 + 5] = true;
  eeprom.dead[2144 + 4 * 30 + 25] = true;  // a mark
  for (int i = 0; i < 140; ++i) {
    Ring ring(eeprom);
    if (i > 0) {
      ASSERT_EQ(Known::kAtRest, ring.known);
      ASSERT_TRUE(same(positionOf(i - 1), ring.position)) << i;
    }
    ring.slots.beginMoving();
    ring.settle();
    ASSERT_TRUE(ring.slots.mayMove());
    ASSERT_EQ(i > 0 ? Known::kMoving : Known::kNothing, Ring(eeprom).known);
    ring.slots.keep(positionOf(i));
    ring.settle();
  }
}

TEST(Position, AgreesOnlyWithItsScaleAndItsPlace) {
  Position kept = positionOf(1);
  kept.scale = 77;
  EXPECT_EQ(Agreement::kAgrees, compare(kept, 77, kept.x + 0.1f, kept.y - 0.2f));
  EXPECT_EQ(Agreement::kPlaceDiffers, compare(kept, 77, kept.x + 0.4f, kept.y - 0.4f));
  EXPECT_EQ(Agreement::kPlaceDiffers, compare(kept, 77, NAN, kept.y));
  EXPECT_EQ(Agreement::kScaleChanged, compare(kept, 78, kept.x, kept.y));
  kept.has_place = false;
  EXPECT_EQ(Agreement::kAgrees, compare(kept, 77, 1e6f, kept.y));
}
