// Lines and arcs pass where they should; what cannot be drawn is refused with a reason.
#include <gtest/gtest.h>

#include "machines.h"

using namespace motion;

namespace {

typedef Point<double> Spot;

const double kNan = nan("");

double apart(Spot a, Spot b) { return hypot(a.x - b.x, a.y - b.y); }

void expectAt(Spot expected, Spot found, double within = 1e-9) {
  EXPECT_NEAR(expected.x, found.x, within);
  EXPECT_NEAR(expected.y, found.y, within);
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

TEST(Arc, ShortArcsAreAsLongAsTheirChordInFloat) {
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

TEST(Arc, ThatEndsOnTheRayOfItsStartIsAFullTurn) {
  for (Turn turn : {Turn::kClockwise, Turn::kCounterclockwise})
    EXPECT_NEAR(20.02 * 6.283185307, arc(Spot{20, 0}, Spot{20.04, 0}, Spot{0, 0}, turn).length,
                1e-5);
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

TEST(Path, HasTheSameSpeedAllAlong) {
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

TEST(Path, AgreesInFloatAndDouble) {
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

TEST(Arc, ClearanceOfAShortArcIsNotThatOfItsWholeCircle) {
  const Path<double> path = arc(Spot{0, 0}, Spot{10, 0.05}, Spot{0, 1000}, Turn::kCounterclockwise);
  EXPECT_EQ(Drawn::kYes, path.drawn);
  EXPECT_GT(clearance(path, Spot{1000, 1000}), 1300);  // on the circle, far from the piece
}

TEST(Arc, ClearanceAllowsForAGrowingRadius) {
  const Path<double> path = arc(Spot{0, 20}, Spot{0, 20.04}, Spot{0, 0}, Turn::kClockwise);
  EXPECT_NEAR(29.96, clearance(path, Spot{0, 50}), 1e-9);
}

TEST(Arc, JoinsEndsOfRoundedTextEvenly) {
  const Path<double> path = arc(Spot{20, 0}, Spot{0, 20.04}, Spot{0, 0}, Turn::kCounterclockwise);
  ASSERT_EQ(Drawn::kYes, path.drawn);
  for (int k = 0; k <= 100; ++k)
    EXPECT_NEAR(20 + 0.0004 * k, apart(placeOn(path, k / 100.0), {0, 0}), 1e-9);
}

TEST(Arc, EndsOnAnotherCircleAreRefused) {
  EXPECT_EQ(Drawn::kYes, drawnArc({20, 0}, {0, 20.07}, {0, 0}));
  EXPECT_EQ(Drawn::kEndOffArc, drawnArc({20, 0}, {0, 20.08}, {0, 0}));
  EXPECT_EQ(Drawn::kYes, drawnArc({200, 0}, {0, 200.15}, {0, 0}));
  EXPECT_EQ(Drawn::kEndOffArc, drawnArc({200, 0}, {0, 200.25}, {0, 0}));
  EXPECT_EQ(Drawn::kEndOffArc, drawnArc({3, 4}, {3.1, 4}, {3, 4}));
}

TEST(Arc, LengthIncludesAGrowingRadius) {
  const Path<double> path =
      arc(Spot{20, 0}, Spot{20.05, 0.03}, Spot{0, 0}, Turn::kCounterclockwise);
  EXPECT_NEAR(hypot(0.05, 0.03), path.length, 1e-4);
  expectAt({20.025, 0.015}, {placeOn(path, 0.5).x, placeOn(path, 0.5).y}, 1e-4);
}

TEST(Arc, StartsAndEndsInTheDirectionOfItsTurn) {
  for (double radius : {20.0, 19.93, 20.0699, 20.0001}) {
    const Point<float> from = {20, 0}, to = {float(radius), 0.05f};
    const Path<float> path = arc(from, to, {0, 0}, Turn::kCounterclockwise);
    const Point<float> set_out = directionOf(path, false), arrival = directionOf(path, true);
    const double length = hypot(radius - 20, 0.05);
    for (const Point<float>& way : {set_out, arrival}) {
      EXPECT_NEAR((radius - 20) / length, double(way.x), 0.004) << radius;
      EXPECT_NEAR(0.05 / length, double(way.y), 0.004) << radius;
    }
  }
  const Path<float> back = arc(Point<float>{20, 0.05f}, {20.05f, 0}, {0, 0}, Turn::kClockwise);
  EXPECT_NEAR(0.7071, double(directionOf(back, true).x), 0.004);
  EXPECT_NEAR(-0.7071, double(directionOf(back, true).y), 0.004);
}

TEST(Arc, WithoutADefiniteCentreIsALine) {
  for (const Spot centre : {Spot{0, 0}, Spot{0.05, 0}, Spot{0.01, 0}}) {
    const Path<double> path = arc(Spot{0, 0}, Spot{0.05, 0}, centre, Turn::kClockwise);
    EXPECT_EQ(Drawn::kYes, path.drawn);
    EXPECT_EQ(0, path.sweep);
    EXPECT_DOUBLE_EQ(0.05, path.length);
  }
  EXPECT_NE(0, arc(Spot{0, 0}, Spot{0.05, 0}, Spot{0.025, 0.01}, Turn::kClockwise).sweep);
}

TEST(Arc, WithEndsRoundedPastEachOtherIsNotAFullTurn) {
  const auto past = [](double gap, float digit) {
    return arc(Spot{0, 0}, Spot{-gap, 0}, Spot{0, 50}, Turn::kCounterclockwise, digit);
  };
  EXPECT_EQ(0, past(0.013, kMillimetreDigit).sweep);
  EXPECT_DOUBLE_EQ(0.013, past(0.013, kMillimetreDigit).length);
  EXPECT_GT(past(0.016, kMillimetreDigit).length, 300);
  EXPECT_EQ(0, past(0.034, kInchDigit).sweep);
  EXPECT_GT(past(0.038, kInchDigit).length, 300);
  EXPECT_NE(0, past(-0.013, kMillimetreDigit).sweep);
}

TEST(Arc, IsAPointIfTheCircleIsSmallerThanTheRoundingOfItsText) {
  const auto circle = [](double radius, float digit) {
    return arc(Spot{1, 1}, Spot{1, 1}, Spot{1 + radius, 1}, Turn::kClockwise, digit).drawn;
  };
  EXPECT_EQ(Drawn::kNoLength, circle(0, kMillimetreDigit));
  EXPECT_EQ(Drawn::kNoLength, circle(0.028, kMillimetreDigit));
  EXPECT_EQ(Drawn::kYes, circle(0.029, kMillimetreDigit));
  EXPECT_EQ(Drawn::kNoLength, circle(0.0718, kInchDigit));
  EXPECT_EQ(Drawn::kYes, circle(0.0719, kInchDigit));
}

TEST(Path, OfZeroLengthIsRefused) {
  EXPECT_EQ(Drawn::kNoLength, line(Spot{3, 4}, Spot{3, 4}).drawn);
}

TEST(Path, OfNaNIsRefused) {
  for (double bad : {kNan, double(INFINITY), -double(INFINITY), 1e200}) {
    EXPECT_EQ(Drawn::kNoNumber, line(Spot{bad, 0}, Spot{1, 1}).drawn) << bad;
    EXPECT_EQ(Drawn::kNoNumber, line(Spot{0, 0}, Spot{1, bad}).drawn) << bad;
    EXPECT_EQ(Drawn::kNoNumber, drawnArc({bad, 0}, {0, 1}, {0, 0})) << bad;
    EXPECT_EQ(Drawn::kNoNumber, drawnArc({1, 0}, {0, bad}, {0, 0})) << bad;
    EXPECT_EQ(Drawn::kNoNumber, drawnArc({1, 0}, {0, 1}, {0, bad})) << bad;
  }
}
