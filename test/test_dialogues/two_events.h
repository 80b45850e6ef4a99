// Two events at once, and the law for any such pair: nothing moves that the table of states does
// not say, and afterwards the place is true or unknown. For the host's build of the firmware and
// for the flashed program.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "machine/course.h"
#include "player.h"

namespace two_events {

extern const int kEventCount, kSceneCount;

/// The text of an event.
std::string nameOf(int event);

/// A scene, two events at drawn moments, and an end at which the machine is asked where it is.
std::vector<Step> stepsOf(int scene, int first, int second, std::mt19937& random);

/// The watched state of a machine.
struct Seen {
  machine::State state;
  bool is_powered;                                                   ///< any motor
  bool is_trusted;                                                   ///< the lengths of all axes
  float targets[machine::kAxisCount], lengths[machine::kAxisCount];  ///< [mm]
};

/// Watches a machine while a dialogue is played, at every millisecond.
class Law {
 public:
  Law(const Player& player, world::World& world) : player_(player), world_(world) {}

  void look(const Seen& seen);
  /// What broke the law first, or nothing.
  const std::string& broken() const { return broken_; }
  /// How often it was checked that nothing moves that must stand, and that the place is true.
  int timesStill() const { return times_still_; }
  int timesPlace() const { return times_place_; }

 private:
  void checkStill(const Seen& seen);
  void checkPlace(const Seen& seen);
  void breaks(const std::string& what);

  const Player& player_;
  world::World& world_;
  machine::State state_ = machine::State::kRunning;
  std::string step_, broken_;
  long unchanged_ms_ = 0, powered_ms_ = 0;
  bool is_encoder_lost_ = false;  ///< for a while
  bool has_jogged_ = true;        ///< a line for z may have come since the last hold
  float were_[machine::kAxisCount] = {0, 0, 0};
  int times_still_ = 0, times_place_ = 0;
};

}  // namespace two_events
