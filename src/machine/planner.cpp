// Turns settings into limits, and checks whether a path leaves the sheet.
#include "planner.h"

#include "settings_table.h"

namespace machine {

float Planner::mostChainSpeed(const settings::Values& values) {
  return AxisLoop::kMostRpm * float(fabs(values.at(kChainPerTurn)));
}

void Planner::prepare(const settings::Values& values, float seconds_per_tick) {
  // $13 may have been lowered since $68 was set.
  const float most = mostChainSpeed(values), asked = values.at(kChainSpeed);
  const float chain_speed = asked < most ? asked : most;
  moves_.prepare(
      {values.at(kAccelerationXy), values.at(kAccelerationZ), chain_speed / 60,
       values.at(kZSpeed) * float(fabs(values.at(kZPerTurn))) / 60, values.at(kCornerDeviation)},
      seconds_per_tick);
  greatest_feed_ = values.at(kGreatestFeed) / 60;
  moves_.boost(boost_, greatest_feed_, rapid_);
}

void Planner::boost(float times, float rapid) {
  boost_ = times;
  rapid_ = rapid;
  moves_.boost(times, greatest_feed_, rapid);
}

void Planner::setGeometry(const Geometry& geometry) {
  moves_.setSprockets(geometry.sprockets());
  moves_.setArea(geometry.smoothArea());
}

bool Planner::add(const motion::Path<float>& path, float z_to, float feed, motion::Space space,
                  uint8_t beam, bool is_rapid) {
  const motion::Added added = moves_.add(path, z_to, feed, space, beam, is_rapid);
  return added == motion::Added::kYes || added == motion::Added::kNothing;
}

void Planner::addAxis(Axis axis, float length, float feed) {
  const SetPoint& at = moves_.last();
  const motion::Point<float> from = {motion::toMm<float>(at.left), motion::toMm<float>(at.right)};
  motion::Point<float> to = from;
  float z_to = motion::toMm<float>(at.z);
  (axis == kLeftAxis ? to.x : axis == kRightAxis ? to.y : z_to) = length;
  moves_.add(motion::line(from, to), z_to, feed, motion::Space::kChains);
}

void Planner::standHere(Axes& axes) {
  axes.dropSetPoints();
  moves_.standAt(axes.setPoint());
}

bool Planner::fill(Axes& axes, const Geometry& geometry) {
  const auto exactly = [&geometry](motion::Point<float> place) { return geometry.inverse(place); };
  const bool is_z_near = moves_.awaitsZ() && axes.isZNear();
  const motion::Filled filled = moves_.fill(axes.setPoints(), exactly, is_z_near);
  return filled == motion::Filled::kYes;
}

}  // namespace machine
