// Where the judge's sled comes to rest: machines and chains on standard input, places out.
// It knows nothing of the laws in lib/; data with a hidden effect come from here.
//
// Each line is one of
//   NAME VALUE            a number of the machine on which every later sled hangs; what is not said
//                         is the judge's own default; left.NAME and right.NAME are of one side
//   place LEFT RIGHT X Y  chains paid out [mm] and a push on the sled [N]; prints "x y" [mm]
//   paid X Y              a place [mm]; prints the chains "left right" [mm] that hold the sled
//   usual                 every number as the judge has it by default; prints nothing
// A sled that cannot hang prints "nan nan". An unknown name ends the program with 2. Each answer is
// sent at once, so that one program can serve many boards.
#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <sstream>
#include <string>

#include "reference/reference.h"

namespace {

using reference::ChainSide;
using reference::Machine;

/// The judge's machine, and a bit that is off the ring's centre while the sled turns.
struct Hidden {
  Machine machine;
  Eigen::Vector2d bit_from_ring = Eigen::Vector2d::Zero();  ///< [mm] with the sled upright
};

/// Where each number of a machine is kept, by its name.
std::map<std::string, double*> numbersOf(Hidden& hidden) {
  Machine& machine = hidden.machine;
  std::map<std::string, double*> found = {
      {"motor_gap", &machine.motor_gap},
      {"motor_height", &machine.motor_height},
      {"motor_center_x", &machine.motor_center_x},
      {"height_difference", &machine.height_difference},
      {"sprocket_radius", &machine.sprocket_radius},
      {"rotation_radius", &machine.rotation_radius},
      {"sled_weight", &machine.sled_weight},
      {"lean", &machine.lean},
      {"plane_gap", &machine.plane_gap},
      {"bit_right", &hidden.bit_from_ring.x()},
      {"bit_up", &hidden.bit_from_ring.y()},
  };
  for (ChainSide* side : {&machine.left, &machine.right}) {
    const std::string whose = side == &machine.left ? "left." : "right.";
    found[whose + "weight"] = &side->weight;
    found[whose + "compliance"] = &side->compliance;
    found[whose + "pitch"] = &side->pitch;
    found[whose + "zero"] = &side->zero;
    found[whose + "inward"] = &side->inward;
    found[whose + "downward"] = &side->downward;
    found[whose + "eccentric_x"] = &side->eccentricity.x();
    found[whose + "eccentric_y"] = &side->eccentricity.y();
  }
  return found;
}

/// [mm] what the turn of the sled adds to its bit: half the difference of both pulls' angles.
Eigen::Vector2d swing(const Hidden& hidden, const reference::Hang& hang) {
  const double left = std::atan2(hang.left.pull.y(), -hang.left.pull.x());
  const double right = std::atan2(hang.right.pull.y(), hang.right.pull.x());
  const double turn = (right - left) / 2, cosine = std::cos(turn), sine = std::sin(turn);
  const Eigen::Vector2d& upright = hidden.bit_from_ring;
  return {cosine * upright.x() - sine * upright.y() - upright.x(),
          sine * upright.x() + cosine * upright.y() - upright.y()};
}

void print(bool solved, const Eigen::Vector2d& pair) {
  if (solved)
    std::printf("%.12g %.12g\n", pair.x(), pair.y());
  else
    std::printf("nan nan\n");
  std::fflush(stdout);
}

void answerPlace(Hidden hidden, std::istream& line) {
  Eigen::Vector2d paid_out;
  line >> paid_out.x() >> paid_out.y() >> hidden.machine.push.x() >> hidden.machine.push.y();
  const reference::Settled rest = reference::settle(hidden.machine, paid_out);
  print(rest.solved && line, rest.bit + swing(hidden, rest.hang));
}

void answerPaid(const Hidden& hidden, std::istream& line) {
  Eigen::Vector2d bit;
  line >> bit.x() >> bit.y();
  const reference::Hang hang = reference::hangAt(hidden.machine, bit);
  print(hang.solved && line, hang.paid_out);
}

}  // namespace

int main() {
  Hidden hidden;
  std::map<std::string, double*> numbers = numbersOf(hidden);
  for (std::string text; std::getline(std::cin, text);) {
    std::istringstream line(text);
    std::string word;
    if (!(line >> word)) continue;
    if (word == "usual") {
      hidden = Hidden();
    } else if (word == "place") {
      answerPlace(hidden, line);
    } else if (word == "paid") {
      answerPaid(hidden, line);
    } else if (!numbers.count(word) || !(line >> *numbers[word])) {
      std::cerr << "judge_marks: cannot read '" << text << "'\n";
      return 2;
    }
  }
  return 0;
}
