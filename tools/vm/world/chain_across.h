// A chain that is hooked on the other motor's sprocket, as for measuring the motor gap.
#pragma once

#include <Eigen/Core>
#include <stdexcept>

#include "reference/across.h"

namespace world {

/// What the chain between the sprockets does to both motors. The judge hangs it from each place.
class ChainAcross {
 public:
  /// Hooks the chain of a hand with `beyond` [mm] of links past 12 o'clock of the other sprocket.
  void hook(reference::Hand hand, double beyond) {
    hand_ = hand;
    beyond_ = beyond;
    at_ = reference::Across();
    is_hooked_ = true;
  }
  void unhook() { is_hooked_ = false; }
  bool isHooked() const { return is_hooked_; }

  /// Lets the chain come to rest after `links` [mm] are out. It keeps its last pull where the judge
  /// finds none.
  void hang(const reference::Machine& machine, double links) {
    const reference::Across next = reference::stretchAcross(machine, hand_, links, beyond_, at_);
    if (next.solved) at_ = next;
  }

  double pull() const { return is_hooked_ ? at_.pull.norm() : 0; }             ///< [N]
  double otherPull() const { return is_hooked_ ? at_.other_pull.norm() : 0; }  ///< [N]
  double drop() const { return is_hooked_ ? at_.drop : 0; }  ///< [mm] of its middle
  reference::Hand hand() const { return hand_; }
  bool isSolved() const { return at_.solved; }

 private:
  reference::Hand hand_ = reference::Hand::kLeft;
  double beyond_ = 0;  ///< [mm]
  reference::Across at_;
  bool is_hooked_ = false;
};

}  // namespace world
