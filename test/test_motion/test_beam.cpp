// A laser's strength applies to its own move only, and follows the speed.
#include <gtest/gtest.h>

#include "plain.h"

using namespace motion;

namespace {

/// A plain machine whose moves along x have a beam each.
class Engraver : public Plain {
 public:
  void burnTo(float x, uint8_t beam, float feed = 10) {
    while (!mover.hasRoom()) step();
    mover.add(line(at, {x, 0}), 0, feed, Space::kSheet, beam);
    at = {x, 0};
  }

  bool step() {
    const bool took = tick();
    const double now_x = asked.back().x;
    beams.push_back({x_, now_x, playback.beam()});
    x_ = now_x;
    return took;
  }

  void finish() {
    while (step()) {
    }
  }

  struct Lit {
    double from, to;  // [mm]
    uint8_t beam;
  };
  std::vector<Lit> beams;

 private:
  double x_ = 0;
};

}  // namespace

TEST(Beam, IsOffOnMovesWithoutPower) {
  for (const float length : {0.05f, 0.3f, 7.0f}) {
    Engraver engraver;
    for (int i = 1; i <= 60; ++i) engraver.burnTo(float(i) * length, i % 2 ? 0 : 200);
    engraver.finish();
    int lit = 0;
    for (const Engraver::Lit& each : engraver.beams) {
      if (each.beam == 0) continue;
      ++lit;
      // A tick within a rounding of an end belongs to the move in which most of it lies.
      const int move = int((each.from + each.to) / 2 / double(length));
      EXPECT_EQ(1, move % 2) << each.from;
      EXPECT_GE(each.from, move * double(length) - 1e-3);
      EXPECT_LE(each.to, (move + 1) * double(length) + 1e-3);
    }
    if (length > 0.1f) {
      EXPECT_GT(lit, 30);
    }
    EXPECT_EQ(0, engraver.beams.back().beam);
  }
}

TEST(Beam, IsProportionalToTheSpeedAtAnyOverride) {
  Engraver engraver;
  engraver.burnTo(60, 200);
  for (int i = 0; i < 900 && engraver.step(); ++i) {
    if (i == 100) engraver.playback.goAt(128);
    if (i == 200) engraver.playback.goAt(256);
    if (i == 300) engraver.playback.hold();
    if (i == 400) engraver.playback.resume();
  }
  for (const Engraver::Lit& each : engraver.beams)
    EXPECT_NEAR(200 * (each.to - each.from) / 0.1, each.beam, 1.3) << each.from;
  EXPECT_EQ(0, engraver.beams[399].beam);
}

TEST(Beam, IsOffWhileSetPointsAreMissing) {
  Engraver engraver;
  engraver.burnTo(500, 255);
  for (int i = 0; i < 100; ++i) engraver.step();
  EXPECT_EQ(255, engraver.playback.beam());
  for (int i = 0; i < 12; ++i) engraver.tickAlone();
  EXPECT_EQ(0, engraver.playback.beam());
}

TEST(Beam, IsNotStrongerWhenTheFeedIsBoosted) {
  Engraver engraver;
  engraver.mover.boost(2, 20);
  engraver.burnTo(60, 100, 8);
  for (int i = 0; i < 150; ++i) engraver.step();
  EXPECT_NEAR(16, engraver.speeds().back(), 0.1);
  EXPECT_EQ(100, engraver.playback.beam());
}
