// The judge for Python: where a sled with hidden faults comes to rest. It knows nothing of lib/, so
// it generates test data with hidden effects.
#include <nanobind/eigen/dense.h>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>

#include <limits>
#include <map>
#include <string>

#include "reference/numbers.h"
#include "reference/reference.h"

namespace nb = nanobind;

namespace {

using Pairs = nb::ndarray<const double, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;
using Column = nb::ndarray<const double, nb::shape<-1>, nb::c_contig, nb::device::cpu>;
using Places = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

/// The judge's default machine with some of its numbers replaced.
reference::Machine machineWith(const std::map<std::string, double>& given) {
  reference::Machine machine;
  const std::map<std::string, double*> numbers = reference::numbersOf(machine);
  for (const auto& [name, value] : given) reference::field(numbers, name) = value;
  return machine;
}

/// Where a machine's sled comes to rest for each row: (n, 2) [mm]; NaN where it cannot hang.
Places places(const std::map<std::string, double>& numbers, const Pairs& chains,
              const Pairs& pushes, const Column& weights, bool over_top) {
  const size_t count = chains.shape(0);
  if (pushes.shape(0) != count || weights.shape(0) != count)
    throw nb::value_error("chains, pushes and weights must have the same number of rows");
  reference::Machine machine = machineWith(numbers);
  machine.over_top = over_top;
  const Eigen::Vector2d always = machine.push;
  Places result = Places::Constant(count, 2, std::numeric_limits<double>::quiet_NaN());
  for (size_t i = 0; i < count; ++i) {
    machine.sled_weight = weights(i);
    machine.push = always + Eigen::Vector2d(pushes(i, 0), pushes(i, 1));
    const reference::Hang rest =
        reference::settle(machine, Eigen::Vector2d(chains(i, 0), chains(i, 1)));
    if (rest.solved) result.row(i) = rest.bit;
  }
  return result;
}

}  // namespace

NB_MODULE(_judge, module) {
  module.doc() = "The judge: exact statics of elastic catenaries, apart from the model.";
  module.def(
      "places", &places, nb::arg("numbers"), nb::arg("chains"), nb::kw_only(), nb::arg("pushes"),
      nb::arg("weights"), nb::arg("over_top") = true,
      "Where the sled rests, (n, 2) [mm], NaN where it cannot hang. numbers: what differs "
      "from the judge's default machine, by name; left.NAME and right.NAME are of one side. "
      "chains (n, 2) [mm] paid out, more pushes (n, 2) [N] on the sled, weights (n,) [N] of it. "
      "over_top: the chains leave over the top of the sprockets, else below. "
      "KeyError for an unknown name.");
}
