// Queued moves become set-points that stay on the path, within the limits, and end exactly.
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "board_at_rest.h"
#include "machine/course.h"
#include "machine/planner.h"
#include "settings_flash.h"

using namespace machine;

namespace {

struct Place3 {
  double x, y, z;
};

double distance(const Place3& a, const Place3& b) {
  return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) +
                   (a.z - b.z) * (a.z - b.z));
}

/// A mover on the usual ring machine, and where its set-points put the sled.
class World {
 public:
  World() : values_(table_, room_), axes_(board_, board_) {
    for (const auto& [number, value] :
         {std::pair<int, float>{7, 2}, {8, 139.1f}, {160, 8.2e-12f}, {170, 5.2e-6f}})
      EXPECT_EQ(values_.set(uint8_t(number), value), settings::Refusal::kNone);
    axes_.simulate(true);
    axes_.prepare(values_);
    planner_.prepare(values_, axes_.secondsPerTick());
    geometry_.prepare(values_);
    planner_.setGeometry(geometry_);
    standAt(0, 0);
  }

  void standAt(float x, float y) {
    const motion::Lengths<float> lengths = geometry_.inverse({x, y});
    axes_.declare(kLeftAxis, lengths.left);
    axes_.declare(kRightAxis, lengths.right);
    planner_.standAt(axes_.setPoint());
    at_ = {x, y};
  }

  /// As after a start: on counts, at the place that follows from the chains.
  void hangOnCounts(float x, float y) {
    standAt(x, y);
    axes_.standStill();
    const FoundPlace found =
        geometry_.forward(axes_.length(kLeftAxis), axes_.length(kRightAxis), {0, 0});
    ASSERT_TRUE(found.found);
    planner_.standAt(axes_.setPoint());
    at_ = found.at;
  }

  void lineTo(float x, float y, float z, float feed) {
    add(motion::line(at_, motion::Point<float>{x, y}), z, feed);
    at_ = {x, y};
  }

  void add(const motion::Path<float>& path, float z, float feed) {
    while (!planner_.hasRoom()) tick();
    ASSERT_TRUE(planner_.add(path, z, feed, geometry_.spaceOf(path)));
  }

  void tick() {
    ASSERT_TRUE(planner_.fill(axes_, geometry_));
    axes_.tick();
    if (course_.isStopping() && axes_.isAtRest()) {
      planner_.standHere(axes_);
      course_.take(Event::kStood);
    }
    const SetPoint point = axes_.setPoint();
    const FoundPlace found = geometry_.forward(
        motion::toMm<float>(point.left), motion::toMm<float>(point.right),
        places.empty() ? motion::Point<float>{0, 0}
                       : motion::Point<float>{float(places.back().x), float(places.back().y)});
    ASSERT_TRUE(found.found);
    places.push_back({found.at.x, found.at.y, motion::toMm<double>(point.z)});
  }

  bool isDone() { return planner_.isIdle() && axes_.isEmpty(); }
  void run() {
    while (!isDone()) tick();
  }

  void stop() { course_.take(Event::kStop); }
  Geometry& geometry() { return geometry_; }
  SetPoint setPoint() { return axes_.setPoint(); }

  std::vector<Place3> places;

 private:
  FlashTable table_;
  float room_[kSettingCount];
  settings::Values values_;
  BoardAtRest board_;
  Axes axes_;
  Course course_{axes_};
  Planner planner_;
  Geometry geometry_;
  motion::Point<float> at_;
};

const double kTick = 0.01, kGain = 100;

/// Steps from tick to tick [mm], from rest to rest.
std::vector<double> steps(const std::vector<Place3>& places) {
  std::vector<double> lengths;
  for (std::size_t i = 1; i < places.size(); ++i)
    lengths.push_back(distance(places[i], places[i - 1]));
  return lengths;
}

}  // namespace

TEST(Planner, EndsEveryMoveOnTheExactLengths) {
  World world;
  std::mt19937 random(3);
  for (int i = 0; i < 40; ++i) {
    const float x = float(int(random() % 2000) - 1000), y = float(int(random() % 1000) - 500);
    world.lineTo(x, y, 0, 15);
    world.run();
    const motion::Lengths<float> exact = world.geometry().inverse({x, y});
    EXPECT_EQ(world.setPoint().left, motion::toCounts(exact.left));
    EXPECT_EQ(world.setPoint().right, motion::toCounts(exact.right));
  }
}

TEST(Planner, KeepsFeedAndRadiusOnAnArc) {
  World world;
  world.standAt(100, 0);
  world.add(motion::arc(motion::Point<float>{100, 0}, motion::Point<float>{100, 0},
                        motion::Point<float>{0, 0}, motion::Turn::kCounterclockwise),
            0, 12);
  world.run();
  int cruising = 0;
  const std::vector<double> lengths = steps(world.places);
  for (std::size_t i = 50; i + 50 < lengths.size(); ++i, ++cruising)
    EXPECT_NEAR(lengths[i] / kTick, 12, 0.4);
  EXPECT_GT(cruising, 1000);
  for (const Place3& place : world.places) EXPECT_NEAR(std::hypot(place.x, place.y), 100, 0.01);
}

TEST(Planner, BrakesOnAStopAndForgetsTheRest) {
  World world;
  world.lineTo(500, 0, 0, 15);
  world.lineTo(0, 0, 0, 15);
  for (int i = 0; i < 300; ++i) world.tick();
  world.stop();
  const std::size_t before = world.places.size();
  world.run();
  EXPECT_LT((double(world.places.size()) - double(before)) * kTick, 0.35);
  const std::vector<double> lengths = steps(world.places);
  EXPECT_LT(lengths.back() / kTick, 2.5);
}

// [mm] Error that the search leaves in a chain where the other hangs steeply, far off the sheet.
const double kFound = 0.06;  // [mm]
// Below a motor the far chain sags so much that it runs faster than the sled.
const double kSagging = 1.2;

TEST(Planner, ComesBackFromBeyondTheSheetWithoutAJump) {
  const motion::Point<float> places[] = {
      {0, -800}, {-1260, -300}, {1300, -700}, {0, 700}, {1230, 640}};
  for (const motion::Point<float>& place : places) {
    World world;
    world.hangOnCounts(place.x, place.y);
    world.lineTo(0, 0, 0, 15);
    double left = motion::toMm<double>(world.setPoint().left), left_speed = 0;
    double right = motion::toMm<double>(world.setPoint().right), right_speed = 0;
    while (!world.isDone()) {
      world.tick();
      const double next_left = motion::toMm<double>(world.setPoint().left);
      const double next_right = motion::toMm<double>(world.setPoint().right);
      for (const double step : {next_left - left, next_right - right})
        ASSERT_LE(std::fabs(step), kSagging * 15 * kTick) << place.x << " " << place.y;
      for (const double gain : {next_left - left - left_speed, next_right - right - right_speed})
        ASSERT_LE(std::fabs(gain),
                  kGain * kTick * kTick + (world.places.size() < 12 ? kFound : 0.003))
            << place.x << " " << place.y << " tick " << world.places.size();
      left_speed = next_left - left;
      right_speed = next_right - right;
      left = next_left;
      right = next_right;
    }
    EXPECT_NEAR(0, world.places.back().x, 0.01);
    EXPECT_NEAR(0, world.places.back().y, 0.01);
  }
}
