// Lines and arcs pass where they should, and what is no path is refused by name.
#include <gtest/gtest.h>

#include "machines.h"

using namespace motion;

namespace {

typedef Point<double> Spot;

const double kNan = nan("");

double apart(Spot a, Spot b) { return hypot(a.x - b.x, a.y - b.y); }

void expectAt(Spot expected, Spot found) {
  EXPECT_NEAR(expected.x, found.x, 1e-9);
  EXPECT_NEAR(expected.y, found.y, 1e-9);
}

Drawn drawnArc(Spot from, Spot to, Spot centre) {
  return arc(from, to, centre, Turn::kClockwise).drawn;
}

}  // namespace

TEST(Line, PassesEvenlyFromStartToEnd) {
  const Path<double> path = line(Spot{-10, 20}, Spot{20, 60});
  EXPECT_EQ(Drawn::kYes, path.drawn);
  EXPECT_DOUBLE_EQ(50, path.length);
  EXPECT_EQ(0, path.curvature());
  expectAt({-10, 20}, placeOn(path, 0.0));
  expectAt({-4, 28}, placeOn(path, 0.2));
  expectAt({20, 60}, placeOn(path, 1.0));
}

TEST(Arc, CounterclockwiseGoesFromEastOverNorthToWest) {
  const Path<double> path = arc(Spot{15, 5}, Spot{-5, 5}, Spot{5, 5}, Turn::kCounterclockwise);
  EXPECT_EQ(Drawn::kYes, path.drawn);
  EXPECT_NEAR(10 * 3.141592653589793, path.length, 1e-9);
  EXPECT_NEAR(0.1, path.curvature(), 1e-12);
  expectAt({5, 15}, placeOn(path, 0.5));
  expectAt({5 + 10 * sqrt(0.5), 5 + 10 * sqrt(0.5)}, placeOn(path, 0.25));
}

TEST(Arc, ClockwiseGoesFromEastOverSouthToWest) {
  const Path<double> path = arc(Spot{15, 5}, Spot{-5, 5}, Spot{5, 5}, Turn::kClockwise);
  expectAt({5, -5}, placeOn(path, 0.5));
  expectAt({5 - 10 * sqrt(0.5), 5 - 10 * sqrt(0.5)}, placeOn(path, 0.75));
}

TEST(Arc, GoesTheLongWayRoundWhereTheTurnAsksForIt) {
  const Path<double> path = arc(Spot{10, 0}, Spot{0, 10}, Spot{0, 0}, Turn::kClockwise);
  EXPECT_NEAR(15 * 3.141592653589793, path.length, 1e-9);
  expectAt({-10 * sqrt(0.5), -10 * sqrt(0.5)}, placeOn(path, 0.5));
}

TEST(Arc, IsAFullCircleIfItEndsWhereItBegins) {
  for (Turn turn : {Turn::kClockwise, Turn::kCounterclockwise}) {
    const Path<double> path = arc(Spot{3, 4}, Spot{3, 4}, Spot{0, 0}, turn);
    EXPECT_NEAR(10 * 3.141592653589793, path.length, 1e-9);
    expectAt({-3, -4}, placeOn(path, 0.5));
    const Spot quarter = {turn == Turn::kClockwise ? 4.0 : -4.0,
                          turn == Turn::kClockwise ? -3.0 : 3.0};
    expectAt(quarter, placeOn(path, 0.25));
  }
}

TEST(Arc, AShortOneStaysShortInFloat) {
  const Point<float> centre = {1000, 300}, from = {1000, 500}, to = {1000.001f, 500};
  EXPECT_LT(arc(from, to, centre, Turn::kClockwise).length, 0.01f);
  EXPECT_GT(arc(from, to, centre, Turn::kCounterclockwise).length, 1200.0f);
}

TEST(Arc, ShortOnesAreAsLongAsTheirChordInFloat) {
  Paths paths(12);
  for (int i = 0; i < 2000; ++i) {
    const double angle = paths.between(0, 6.2831853), turned = angle + 0.00002;
    const Point<float> centre = {float(paths.between(-20, 20)), float(paths.between(-20, 20))};
    const Point<float> from = {centre.x + 100 * float(cos(angle)),
                               centre.y + 100 * float(sin(angle))};
    const Point<float> to = {centre.x + 100 * float(cos(turned)),
                             centre.y + 100 * float(sin(turned))};
    const double chord = apart({from.x, from.y}, {to.x, to.y});
    const Path<float> path = arc(from, to, centre, Turn::kCounterclockwise);
    ASSERT_NEAR(chord, double(path.length), 1e-6);
  }
}

TEST(Arc, ThatEndsBeyondItsStartOnTheSameRayIsAFullTurn) {
  for (Turn turn : {Turn::kClockwise, Turn::kCounterclockwise})
    EXPECT_NEAR(20.02 * 6.283185307, arc(Spot{20, 0}, Spot{20.04, 0}, Spot{0, 0}, turn).length,
                1e-6);
}

TEST(Path, EndsAreExactToTheLastBit) {
  Paths paths(1);
  for (int i = 0; i < 2000; ++i) {
    const Path<float> path = as<float>(i % 2 ? paths.line() : paths.arc());
    EXPECT_EQ(path.to.x, placeOn(path, 1.0f).x);
    EXPECT_EQ(path.to.y, placeOn(path, 1.0f).y);
    EXPECT_NEAR(path.from.x, placeOn(path, 0.0f).x, 1.3e-4);
    EXPECT_NEAR(path.from.y, placeOn(path, 0.0f).y, 1.3e-4);
  }
}

TEST(Path, WalksItsLengthAtOneSpeed) {
  Paths paths(2);
  for (int i = 0; i < 200; ++i) {
    const Path<double> path = i % 2 ? paths.line() : paths.arc();
    const int steps = 2000;
    for (int k = 0; k < steps; ++k) {
      const double step = apart(placeOn(path, double(k) / steps), placeOn(path, (k + 1.0) / steps));
      ASSERT_NEAR(1, step * steps / path.length, 1e-5);
    }
  }
}

TEST(Path, InFloatIsWhereItIsInDouble) {
  Paths paths(3);
  double worst = 0;
  for (int i = 0; i < 4000; ++i) {
    const Path<float> single = as<float>(i % 2 ? paths.line() : paths.arc());
    const double share = paths.between(0, 1);
    const Spot from = {single.from.x, single.from.y}, to = {single.to.x, single.to.y};
    const Spot centre = {single.centre.x, single.centre.y};
    const Path<double> twice =
        single.sweep == 0
            ? line(from, to)
            : arc(from, to, centre, single.sweep > 0 ? Turn::kCounterclockwise : Turn::kClockwise);
    const Point<float> place = placeOn(single, float(share));
    worst = fmax(worst, apart(placeOn(twice, double(float(share))), {place.x, place.y}));
  }
  EXPECT_LT(worst, 0.0002);
}

TEST(Path, ClearanceIsNeverMoreThanTheDistanceOfAnyPlaceOnIt) {
  Paths paths(4);
  double tightest = 1e9;
  for (int i = 0; i < 2000; ++i) {
    const Path<double> path = i % 2 ? paths.line() : paths.arc();
    const Spot sprocket = {i % 4 < 2 ? -1489.2 : 1489.2, 1072.6};
    const double kept = clearance(path, sprocket);
    double least = 1e9;
    for (int k = 0; k <= 200; ++k) least = fmin(least, apart(placeOn(path, k / 200.0), sprocket));
    ASSERT_LE(kept, least + 1e-6);
    tightest = fmin(tightest, least - kept);
    if (path.sweep == 0) {
      ASSERT_NEAR(kept, least, 0.05);
    }
  }
  EXPECT_LT(tightest, 1e-6);
}

TEST(Arc, ClearanceOfAShortPieceIsNotThatOfItsWholeCircle) {
  const Path<double> path = arc(Spot{0, 0}, Spot{10, 0.05}, Spot{0, 1000}, Turn::kCounterclockwise);
  EXPECT_EQ(Drawn::kYes, path.drawn);
  EXPECT_GT(clearance(path, Spot{1000, 1000}), 1300);  // on the circle, far from the piece
}

TEST(Arc, ClearanceKnowsThatTheRadiusMayGrow) {
  const Path<double> path = arc(Spot{0, 20}, Spot{0, 20.04}, Spot{0, 0}, Turn::kClockwise);
  EXPECT_NEAR(29.96, clearance(path, Spot{0, 50}), 1e-9);
}

TEST(Arc, EndsOfRoundedTextAreJoinedEvenly) {
  const Path<double> path = arc(Spot{20, 0}, Spot{0, 20.04}, Spot{0, 0}, Turn::kCounterclockwise);
  ASSERT_EQ(Drawn::kYes, path.drawn);
  for (int k = 0; k <= 100; ++k)
    EXPECT_NEAR(20 + 0.0004 * k, apart(placeOn(path, k / 100.0), {0, 0}), 1e-9);
}

TEST(Arc, EndsOnAnotherCircleAreRefused) {
  EXPECT_EQ(Drawn::kEndOffArc, drawnArc({20, 0}, {0, 20.06}, {0, 0}));
  EXPECT_EQ(Drawn::kYes, drawnArc({200, 0}, {0, 200.15}, {0, 0}));
  EXPECT_EQ(Drawn::kEndOffArc, drawnArc({200, 0}, {0, 200.25}, {0, 0}));
  EXPECT_EQ(Drawn::kEndOffArc, drawnArc({0.2, 0}, {0, 0.24}, {0, 0}));  // a spiral, for its size
}

TEST(Path, WithoutLengthIsRefused) {
  EXPECT_EQ(Drawn::kNoLength, line(Spot{3, 4}, Spot{3, 4}).drawn);
  EXPECT_EQ(Drawn::kNoRadius, drawnArc({3, 4}, {3, 4}, {3, 4}));
  EXPECT_EQ(Drawn::kNoRadius, drawnArc({3, 4}, {3.01, 4}, {3, 4}));
}

TEST(Path, OfWhatIsNoNumberIsRefused) {
  for (double bad : {kNan, double(INFINITY), -double(INFINITY), 1e200}) {
    EXPECT_EQ(Drawn::kNoNumber, line(Spot{bad, 0}, Spot{1, 1}).drawn) << bad;
    EXPECT_EQ(Drawn::kNoNumber, line(Spot{0, 0}, Spot{1, bad}).drawn) << bad;
    EXPECT_EQ(Drawn::kNoNumber, drawnArc({bad, 0}, {0, 1}, {0, 0})) << bad;
    EXPECT_EQ(Drawn::kNoNumber, drawnArc({1, 0}, {0, bad}, {0, 0})) << bad;
    EXPECT_EQ(Drawn::kNoNumber, drawnArc({1, 0}, {0, 1}, {0, bad})) << bad;
  }
}
