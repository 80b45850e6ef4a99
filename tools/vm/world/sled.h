// The sled on its two chains: where it rests by the judge, and how hard each chain pulls.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <map>
#include <stdexcept>
#include <string>

#include "reference/numbers.h"
#include "reference/reference.h"

namespace world {

/// A sled with friction on the sheet. The judge searches each place from the last place.
class Sled {
 public:
  /// `numbers`: what differs from the judge's default machine, by name. `friction` [N] of the sled
  /// on the sheet. `over_top`: the chains leave over the top of the sprockets, else below. Throws
  /// std::invalid_argument for a name that the judge does not know.
  Sled(const std::map<std::string, double>& numbers, double friction, bool over_top = true)
      : friction_(friction), is_settled_(false) {
    machine_.over_top = over_top;
    for (const auto& each : numbers) set(each.first, each.second);
  }

  /// Gives a number of the judge's machine a new value; the sled moves with the next hang().
  void set(const std::string& name, double value) { *at(name) = value; }
  const reference::Machine& machine() const { return machine_; }

  /// Lets the sled come to rest on chains of `paid_out` [mm left, right]. False where no sled can
  /// hang; the sled then keeps its last place.
  bool hang(const Eigen::Vector2d& paid_out) {
    const reference::Hang next = settled(paid_out, drag_);
    if (!next.solved) return false;
    at_ = next;
    if (friction_ > 0) rub(paid_out);
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
  reference::Hang settled(const Eigen::Vector2d& paid_out, const Eigen::Vector2d& drag) const {
    reference::Machine machine = machine_;
    machine.push += drag;
    if (is_settled_) {
      const reference::Hang near = reference::settleFrom(machine, at_, paid_out);
      if (near.solved) return near;
    }
    return reference::settle(machine, paid_out);
  }

  /// Friction builds up against each movement and gives way at its limit, so the sled's place
  /// depends on the side it came from (Dahl's law without its exponent). The friction moves the
  /// sled by its give. Both are solved together, or a soft sled would swing.
  void rub(const Eigen::Vector2d& paid_out) {
    const double kGivesWayAfter = 0.5;  // [mm]
    const int kGiveLasts = 50;          // [calls] in which a sled moves a few millimetres
    if (give_age_-- <= 0) {
      give_ = giveAt(paid_out);
      give_age_ = kGiveLasts;
    }
    if (!is_settled_) rubbed_at_ = at_.bit;
    const double stiffness = friction_ / kGivesWayAfter;
    const Eigen::Matrix2d both = Eigen::Matrix2d::Identity() + stiffness * give_;
    Eigen::Vector2d next = drag_ - both.inverse() * (stiffness * (at_.bit - rubbed_at_));
    if (next.norm() > friction_) next *= friction_ / next.norm();
    rubbed_at_ = at_.bit + give_ * (next - drag_);
    drag_ = next;
  }

  /// [mm/N] The sled's move under a push, in columns for right and up.
  Eigen::Matrix2d giveAt(const Eigen::Vector2d& paid_out) const {
    const double kPush = 0.5;  // [N]
    Eigen::Matrix2d give = Eigen::Matrix2d::Zero();
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d push = kPush * Eigen::Vector2d::Unit(axis);
      const reference::Hang pushed = settled(paid_out, drag_ + push);
      if (pushed.solved) give.col(axis) = (pushed.bit - at_.bit) / kPush;
    }
    return give;
  }

  double* at(const std::string& name) {
    return &reference::field(reference::numbersOf(machine_), name);
  }

  reference::Machine machine_;
  double friction_;
  Eigen::Vector2d drag_ = Eigen::Vector2d::Zero();  ///< [N] on the sled
  Eigen::Vector2d rubbed_at_ = drag_;               ///< [mm] place at which `drag_` was worked out
  Eigen::Matrix2d give_ = Eigen::Matrix2d::Zero();  ///< [mm/N]
  int give_age_ = 0;                                ///< [calls] until the give is worked out again
  reference::Hang at_;
  bool is_settled_;
};

}  // namespace world
