// Moves over three axes, alone and mixed; the lifting of z; a laser's strength along them.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

#include "plain.h"

using namespace motion;

namespace {

const Limits kQuick = {300, 200, 1000, 40, 0.05f};

double distanceToLine(const Asked& place, const Asked& a, const Asked& b) {
  const double x = b.x - a.x, y = b.y - a.y, z = b.z - a.z, squared = x * x + y * y + z * z;
  double share = ((place.x - a.x) * x + (place.y - a.y) * y + (place.z - a.z) * z) /
                 (squared > 0 ? squared : 1);
  share = std::min(1.0, std::max(0.0, share));
  return distance(place, {a.x + share * x, a.y + share * y, a.z + share * z});
}

/// Moves of all kinds: along the sheet, of z alone, of both, and short moves.
std::vector<Asked> randomCorners(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> way(-20, 20);
  // Lengths and rises of exactly a millimetre first.
  std::vector<Asked> corners = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {1, 1, 2}, {1, 0, 2}};
  for (int i = 0; i < count; ++i) {
    Asked next = corners.back();
    const unsigned kind = random() % 4;
    const double scale = random() % 3 == 0 ? 0.05 : 1;
    if (kind != 0) next.x += scale * way(random), next.y += scale * way(random);
    if (kind < 2) next.z += 0.3 * scale * way(random);
    corners.push_back(next);
  }
  return corners;
}

}  // namespace

TEST(ThreeAxes, EverySetPointLiesOnTheMoves) {
  for (unsigned seed = 1; seed < 6; ++seed) {
    const std::vector<Asked> corners = randomCorners(seed, 60);
    Plain plain(kQuick);
    for (const Asked& corner : corners) {
      if (&corner != &corners[0])
        plain.lineTo(float(corner.x), float(corner.y), float(corner.z), 25);
    }
    plain.run();
    size_t passed = 1;
    for (const Asked& place : plain.asked) {
      // Forward only: the move in progress or a later move.
      while (passed + 1 < corners.size() &&
             distanceToLine(place, corners[passed - 1], corners[passed]) > 0.003)
        ++passed;
      ASSERT_LT(distanceToLine(place, corners[passed - 1], corners[passed]), 0.003)
          << "seed " << seed << ", move " << passed;
    }
    EXPECT_GE(passed, corners.size() - 2) << seed;  // the last may be as short as that
    EXPECT_EQ(toCounts(float(corners.back().x)), plain.now.left) << seed;
    EXPECT_EQ(toCounts(float(corners.back().y)), plain.now.right) << seed;
    EXPECT_EQ(toCounts(float(corners.back().z)), plain.now.z) << seed;
  }
}

TEST(ThreeAxes, LegsCarryTheirLengthAndAcceleration) {
  for (const Asked& to : {Asked{30, 0, 0}, {0, 0, 9}, {20, 15, 6}, {0, 0, -9}}) {
    Plain plain(kQuick);
    plain.lineTo(float(to.x), float(to.y), float(to.z), 12);
    const double length = distance(to, {0, 0, 0});
    const double across = std::hypot(to.x, to.y), rise = std::fabs(to.z);
    double acceleration = 1e9;
    if (across > 0) acceleration = 300 * length / across;
    if (rise > 0) acceleration = std::min(acceleration, 200 * length / rise);
    SetPoint before = {0, 0, 0};
    Leg leg;
    double legs = 0;
    for (;; ++legs) {
      plain.mover.fill(plain.set_points, plain.inverse);
      if (!plain.set_points.take(leg)) break;
      const double way = std::sqrt(std::pow(leg.to.left - before.left, 2.0) +
                                   std::pow(leg.to.right - before.right, 2.0) +
                                   std::pow(leg.to.z - before.z, 2.0));
      // The last leg ends where the move ends, even if its speed would lead farther.
      if (!plain.mover.isIdle()) {
        EXPECT_NEAR(leg.way, way, 12) << legs << ", " << to.x << " " << to.z;
      }
      EXPECT_NEAR(leg.gain, acceleration * 1e-4 * kCountsPerMm, 2) << legs;
      EXPECT_EQ(0, leg.beam) << "nobody asked for a beam";
      before = leg.to;
    }
    EXPECT_GT(legs, 30);
  }
}

TEST(ThreeAxes, ALevelMoveAboveTheSheetIsAsFastAsOnIt) {
  Plain plain({100, 100, 1000, 1, 0.05f});
  plain.lineTo(0, 0, 5, 15);
  plain.run();
  const size_t lifting = plain.asked.size();
  EXPECT_NEAR(double(lifting) * kTick, 5.01, 0.06) << "z at 1 mm/s";
  plain.lineTo(30, 0, 5, 15);
  plain.run();
  EXPECT_NEAR(double(plain.asked.size() - lifting) * kTick, 2.15, 0.06) << "30 mm at 15 mm/s";
}

TEST(ThreeAxes, AMoveAfterAForgottenOneKeepsTheAccelerationOfZ) {
  Plain plain(kQuick);
  plain.lineTo(40, 0);
  for (int i = 0; i < 20; ++i) plain.tick();
  plain.mover.forget();
  plain.set_points.clear();
  plain.mover.add(line(Point<float>{0, 0}, {0, 0}), 9, 12);
  plain.mover.fill(plain.set_points, plain.inverse);
  Leg leg;
  ASSERT_TRUE(plain.set_points.take(leg));
  EXPECT_NEAR(leg.gain, 200 * 1e-4 * kCountsPerMm, 2) << "that of z alone";
}

TEST(ThreeAxes, LegsStayWithinTheRangeOfTheirFields) {
  // A millimetre is 65536 counts; a way has 17 bits, a gain 16, and neither is zero.
  struct {
    float acceleration, feed;
    double seconds;
    uint32_t way, gain;
  } cases[] = {{1e6f, 400, 0.01, (1u << 17) - 1, 65535}, {0.1f, 15, 0.005, 1, 1}};
  for (const auto& each : cases) {
    Plain plain({each.acceleration, 10, 1e6f, 10, 0.05f}, each.seconds);
    plain.lineTo(900, 0, 0, each.feed);
    Leg leg = {};
    for (int i = 0; i < 3; ++i) {
      plain.mover.fill(plain.set_points, plain.inverse);
      ASSERT_TRUE(plain.set_points.take(leg));
      if (each.gain != 1) continue;
      EXPECT_EQ(1u, leg.way) << "0.16 counts a tick and a little more with each";
    }
    EXPECT_EQ(each.way, leg.way) << each.acceleration;
    EXPECT_EQ(each.gain, leg.gain) << each.acceleration;
  }
}

TEST(ThreeAxes, EachRunningDryIsCountedOnce) {
  Plain plain;
  plain.lineTo(500, 0);
  for (int i = 0; i < 100; ++i) plain.tick();
  EXPECT_EQ(0, plain.mover.timesDry());
  for (int round = 1; round <= 2; ++round) {
    for (int i = 0; i < 30; ++i) plain.tickAlone();
    for (int i = 0; i < 50; ++i) plain.tick();
  }
  EXPECT_EQ(2, plain.mover.timesDry());
  EXPECT_EQ(0, plain.mover.timesDry()) << "since it was last asked";
  plain.run();
  for (int i = 0; i < 30; ++i) plain.tickAlone();
  plain.lineTo(400, 0);
  plain.run();
  EXPECT_EQ(0, plain.mover.timesDry()) << "nothing was missing at rest";
}

TEST(ThreeAxes, AForgottenPathLeavesZWhereItStands) {
  Plain plain(kQuick);
  plain.lineTo(40, 0, 10);
  for (int i = 0; i < 100; ++i) plain.tick();
  plain.mover.forget();
  plain.set_points.clear();
  plain.playback.reset();
  const SetPoint stood = plain.mover.last();
  ASSERT_GT(stood.z, 0);
  EXPECT_TRUE(plain.mover.isIdle());
  EXPECT_EQ(0, plain.mover.walk().speed);
  // The next move begins there: z goes on from where it stands, evenly.
  plain.at = {toMm<float>(stood.left), toMm<float>(stood.right)};
  plain.asked.clear();
  plain.now = stood;
  plain.lineTo(plain.at.x + 8, plain.at.y, 0);
  plain.run();
  EXPECT_EQ(0, plain.now.z);
  const double x0 = toMm<double>(stood.left), z0 = toMm<double>(stood.z);
  for (const Asked& place : plain.asked)
    EXPECT_NEAR(place.z, z0 * (1 - (place.x - x0) / 8), 0.003) << place.x;
}

namespace {

const int32_t kTop = 432, kGain = 66;  // [counts/tick] z at 40 mm/min, 10 mm/s^2, 100 Hz

/// Ticks until z rests; speeds and their changes stay within the limits.
int run(Lift& lift, int32_t top = kTop, int32_t gain = kGain) {
  int ticks = 0;
  for (; !lift.isAtRest() && ticks < 1000000; ++ticks) {
    const int32_t before = lift.speed(), at = lift.at();
    lift.advance();
    EXPECT_EQ(lift.at() - at, lift.speed());
    EXPECT_LE(std::abs(lift.speed()), top);
    // The last step, onto the goal, may be up to two gains.
    EXPECT_LE(std::abs(lift.speed() - before), lift.at() == lift.goal() ? 2 * gain : gain);
  }
  return ticks;
}

}  // namespace

TEST(Lift, GoesToItsGoalAndBackInTheTimeOfATrapezoid) {
  Lift lift;
  for (const int32_t goal : {327680, -3000, 40, -1, 100000}) {
    lift.goTo(goal, kTop, kGain);
    const int32_t way = std::abs(goal - lift.at());
    const double most = double(way) / kTop + double(kTop) / kGain + 3;
    EXPECT_LE(run(lift), way > kTop * 10 ? most : 2 * std::sqrt(double(way) / kGain) + 4) << goal;
    EXPECT_EQ(goal, lift.at());
  }
  lift.goTo(0, kTop, kGain);
  run(lift);
  EXPECT_EQ(0, lift.at());
}

TEST(Lift, TakesANewGoalAtAnyMoment) {
  std::mt19937 random(5);
  Lift lift;
  for (int round = 0; round < 3000; ++round) {
    lift.goTo(int32_t(random() % 20000) - 10000, kTop, kGain);
    for (int i = int(random() % 60); i > 0 && !lift.isAtRest(); --i) {
      const int32_t before = lift.speed();
      lift.advance();
      EXPECT_LE(std::abs(lift.speed()), kTop);
      EXPECT_LE(std::abs(lift.speed() - before), 2 * kGain);
    }
  }
  run(lift);
  EXPECT_EQ(lift.goal(), lift.at());
}

TEST(Lift, StaysAtADeclaredHeight) {
  Lift lift;
  EXPECT_TRUE(lift.isAtRest());
  EXPECT_EQ(0, lift.at());
  EXPECT_EQ(0, lift.goal());
  lift.goTo(10000, kTop, kGain);
  for (int i = 0; i < 5; ++i) lift.advance();
  EXPECT_GT(lift.speed(), 0);
  lift.standAt(500);
  EXPECT_TRUE(lift.isAtRest());
  EXPECT_EQ(500, lift.at());
  lift.absorb();
  EXPECT_EQ(0, lift.at());
  EXPECT_TRUE(lift.isAtRest());
}

TEST(Lift, DoesNotOverflowWithAHugeGain) {
  Lift lift;
  lift.goTo(1000000000, 2000000000, 1);
  for (int i = 0; i < 2000; ++i) {
    lift.advance();
    EXPECT_GT(lift.speed(), 0);
    EXPECT_LE(lift.speed(), 1 << 17);
    // Braking takes at most a thousand ticks, whatever the commanded gain.
    EXPECT_EQ(std::min((i + 1) * ((1 << 17) / 1000 + 1), 1 << 17), lift.speed()) << i;
  }
  EXPECT_EQ(1 << 17, lift.speed());
}

TEST(Lift, BrakesAsSoonAsItCanAndStays) {
  std::mt19937 random(7);
  for (int round = 0; round < 300; ++round) {
    Lift lift;
    lift.goTo(round % 2 ? 20000 : -20000, kTop, kGain);
    for (unsigned i = random() % 60; i > 0; --i) lift.advance();
    const int32_t from = lift.at(), speed = lift.speed();
    lift.brake();
    const int32_t first = lift.goal();
    lift.advance();
    lift.brake();
    EXPECT_EQ(first, lift.goal()) << "a second hold changes nothing";
    run(lift);
    EXPECT_EQ(first, lift.at());
    EXPECT_LE(std::abs(lift.at() - from), speed * double(speed) / (2 * kGain));
    EXPECT_GE((lift.at() - from) * (speed < 0 ? -1 : 1), 0);
  }
}

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
