// The judge seen from Python: where a sled with hidden faults comes to rest.
// It knows nothing of the laws in lib/; data with a hidden effect come from here.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "reference/reference.h"

namespace nb = nanobind;

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

using Pairs = nb::ndarray<const double, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;
using Column = nb::ndarray<const double, nb::shape<-1>, nb::c_contig, nb::device::cpu>;

/// The judge's default machine with some of its numbers replaced.
void replaceNumbers(Hidden& hidden, const std::map<std::string, double>& numbers) {
  const std::map<std::string, double*> known = numbersOf(hidden);
  for (const auto& [name, value] : numbers) {
    const auto number = known.find(name);
    if (number == known.end())
      throw nb::key_error(("the judge knows no number '" + name + "'").c_str());
    *number->second = value;
  }
}

/// Where the sled of one machine comes to rest for each row: (n, 2) [mm]; NaN where it cannot hang.
nb::ndarray<nb::numpy, double> places(const std::map<std::string, double>& numbers,
                                      const Pairs& chains, const Pairs& pushes,
                                      const Column& weights) {
  const size_t count = chains.shape(0);
  if (pushes.shape(0) != count || weights.shape(0) != count)
    throw nb::value_error("chains, pushes and weights must have the same number of rows");
  Hidden hidden;
  replaceNumbers(hidden, numbers);
  double* data = new double[2 * count];
  nb::capsule owner(data, [](void* p) noexcept { delete[] static_cast<double*>(p); });
  for (size_t i = 0; i < count; ++i) {
    hidden.machine.sled_weight = weights(i);
    hidden.machine.push = {pushes(i, 0), pushes(i, 1)};
    const reference::Settled rest =
        reference::settle(hidden.machine, Eigen::Vector2d(chains(i, 0), chains(i, 1)));
    const Eigen::Vector2d bit = rest.bit + swing(hidden, rest.hang);
    for (int k = 0; k < 2; ++k)
      data[2 * i + k] = rest.solved ? bit[k] : std::numeric_limits<double>::quiet_NaN();
  }
  return nb::ndarray<nb::numpy, double>(data, {count, 2}, owner);
}

}  // namespace

NB_MODULE(_judge, module) {
  module.doc() = "The judge: exact statics of elastic catenaries, apart from the model.";
  module.def("places", &places, nb::arg("numbers"), nb::arg("chains"), nb::kw_only(),
             nb::arg("pushes"), nb::arg("weights"),
             "Where the sled rests, (n, 2) [mm], NaN where it cannot hang. numbers: what differs "
             "from the judge's default machine, by name; left.NAME and right.NAME are of one side. "
             "chains (n, 2) [mm] paid out, pushes (n, 2) [N] on the sled, weights (n,) [N] of it. "
             "KeyError for an unknown name.");
}
