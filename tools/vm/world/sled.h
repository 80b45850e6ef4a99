// The sled on its two chains: where the judge says it rests, and how hard each chain pulls.
#pragma once

#include <Eigen/Core>
#include <map>
#include <stdexcept>
#include <string>

#include "reference/numbers.h"
#include "reference/reference.h"

namespace world {

/// A sled that the sheet rubs against. The judge finds each place from the last.
class Sled {
 public:
  /// `numbers`: what differs from the judge's default machine, by name. `friction` [N] of the sled
  /// on the sheet. Throws std::invalid_argument for a name that the judge does not know.
  Sled(const std::map<std::string, double>& numbers, double friction)
      : friction_(friction), is_settled_(false) {
    for (const auto& each : numbers) set(each.first, each.second);
  }

  /// Gives a number of the judge's machine a new value; the sled moves with the next hang().
  void set(const std::string& name, double value) { *at(name) = value; }
  double get(const std::string& name) { return *at(name); }

  /// Lets the sled come to rest on chains of `paid_out` [mm left, right]. False where no sled can
  /// hang; the place is then the last.
  bool hang(const Eigen::Vector2d& paid_out) {
    reference::Machine machine = machine_;
    machine.push += drag_;
    reference::Hang next;
    if (is_settled_) next = reference::settleFrom(machine, at_, paid_out);
    if (!next.solved) next = reference::settle(machine, paid_out).hang;
    if (!next.solved) return false;
    if (is_settled_) rub(next.bit - at_.bit);
    at_ = next;
    is_settled_ = true;
    return true;
  }

  /// [mm left, right] The chains that hold the bit of this sled at a place, without friction.
  Eigen::Vector2d chainsTo(const Eigen::Vector2d& place) const {
    const reference::Hang hang = reference::hangAt(machine_, place);
    if (!hang.solved) throw std::invalid_argument("no sled can hang there");
    return hang.paid_out;
  }

  const Eigen::Vector2d& place() const { return at_.bit; }               ///< [mm] of the bit
  double leftTension() const { return at_.left.tension_at_sprocket; }    ///< [N]
  double rightTension() const { return at_.right.tension_at_sprocket; }  ///< [N]

 private:
  /// Friction builds up against each movement and gives way at its limit, so that the sled
  /// remembers from which side it came (Dahl's law without its exponent).
  void rub(const Eigen::Vector2d& moved) {
    const double kGivesWayAfter = 0.5;  // [mm]
    drag_ -= moved * (friction_ / kGivesWayAfter);
    if (drag_.norm() > friction_) drag_ *= friction_ / drag_.norm();
  }

  double* at(const std::string& name) {
    const std::map<std::string, double*> numbers = reference::numbersOf(machine_);
    const auto number = numbers.find(name);
    if (number == numbers.end()) throw std::invalid_argument(reference::lacks(name));
    return number->second;
  }

  reference::Machine machine_;
  double friction_;
  Eigen::Vector2d drag_ = Eigen::Vector2d::Zero();  ///< [N] on the sled
  reference::Hang at_;
  bool is_settled_;
};

}  // namespace world
