// lib/Kinematics for Python: arrays in, arrays out, without any physics here.
#include "arrays.h"
#include "bindings.h"
#include "dual.h"
// The definitions too: this file instantiates them for dual numbers.
#include "Kinematics.cpp"
#include "reach.cpp"

namespace nb = nanobind;
using namespace kinematics;
using namespace core;

namespace {

using Slopes = dual::Dual<kSettingCount + 2>;

template <class Real>
Machine<Real> machineOf(const std::vector<Real>& values, bool over_top) {
  const Described<Real> described = describedBy(values, over_top);
  return prepare(described.frame, described.effects);
}

/// What `answer` writes for each row (n, 2) of pairs, and whether it was found (n,).
template <class Answer>
nb::tuple answersTo(const Pairs& pairs, const Answer& answer) {
  double* numbers;
  uint8_t* found;
  const size_t count = pairs.shape(0);
  auto results = newArray<double>({count, 2}, &numbers);
  auto founds = newArray<uint8_t>({count}, &found);
  for (size_t i = 0; i < count; ++i)
    found[i] = static_cast<uint8_t>(answer(i, numbers[2 * i], numbers[2 * i + 1]));
  return nb::make_tuple(results, founds);
}

template <class Real>
nb::tuple lengthsOf(const Values& values, bool over_top, const Pairs& points) {
  const Machine<Real> machine = machineOf(numbers<Real>(values), over_top);
  return answersTo(points, [&](size_t i, double& left, double& right) {
    const PaidOut<Real> paid = inverse(
        machine, Point<Real>{static_cast<Real>(points(i, 0)), static_cast<Real>(points(i, 1))});
    left = static_cast<double>(paid.chains.left);
    right = static_cast<double>(paid.chains.right);
    return paid.found;
  });
}

nb::tuple lengths(const Values& values, bool over_top, const Pairs& points, bool float32) {
  return float32 ? lengthsOf<float>(values, over_top, points)
                 : lengthsOf<double>(values, over_top, points);
}

nb::tuple places(const Values& values, bool over_top, const Pairs& chains) {
  const Machine<double> machine = machineOf(numbers<double>(values), over_top);
  return answersTo(chains, [&](size_t i, double& x, double& y) {
    const Chains<double> paid_out = {chains(i, 0), chains(i, 1)};
    Place<double> at = forward(machine, paid_out);
    // The board's search stops within a few micrometres. A second search from there is exact.
    if (at.found == Found::kYes) at = forward(machine, paid_out, at.sled);
    x = at.sled.x;
    y = at.sled.y;
    return at.found;
  });
}

/// Returns slopes by setting (n, 2, settings), slopes by place (n, 2, 2), and `found` (n,).
nb::tuple slopes(const Values& values, bool over_top, const Pairs& points) {
  std::vector<Slopes> inputs;
  const std::vector<double> plain = numbers<double>(values);
  for (int i = 0; i < kSettingCount; ++i) inputs.push_back(Slopes::input(plain[i], i));
  const Machine<Slopes> machine = machineOf(inputs, over_top);
  double* by_setting;
  double* by_place;
  uint8_t* found;
  const size_t count = points.shape(0);
  auto setting_slopes = newArray<double>({count, 2, kSettingCount}, &by_setting);
  auto place_slopes = newArray<double>({count, 2, 2}, &by_place);
  auto founds = newArray<uint8_t>({count}, &found);
  for (size_t i = 0; i < count; ++i) {
    const PaidOut<Slopes> paid =
        inverse(machine, Point<Slopes>{Slopes::input(points(i, 0), kSettingCount),
                                       Slopes::input(points(i, 1), kSettingCount + 1)});
    found[i] = static_cast<uint8_t>(paid.found);
    const Slopes* side[2] = {&paid.chains.left, &paid.chains.right};
    for (size_t k = 0; k < 2; ++k) {
      std::copy_n(side[k]->slope.begin(), +kSettingCount, by_setting + (2 * i + k) * kSettingCount);
      std::copy_n(side[k]->slope.begin() + kSettingCount, 2, by_place + (2 * i + k) * 2);
    }
  }
  return nb::make_tuple(setting_slopes, place_slopes, founds);
}

/// Numbers of the strands against which errors are drawn: each (n, 2), left and right.
nb::dict strands(const Values& values, bool over_top, const Pairs& points) {
  const Machine<double> machine = machineOf(numbers<double>(values), over_top);
  static const struct {
    const char* name;
    double Strand<double>::*member;
  } kShown[] = {{"free", &Strand<double>::free},     {"sine", &Strand<double>::sine},
                {"cosine", &Strand<double>::cosine}, {"pull", &Strand<double>::pull},
                {"wrap", &Strand<double>::wrap},     {"length", &Strand<double>::length}};
  nb::dict result;
  for (const auto& shown : kShown) {
    double* value;
    auto array = newArray<double>({points.shape(0), 2}, &value);
    for (size_t i = 0; i < points.shape(0); ++i) {
      const Hanging<double> hanging =
          hang(machine, Point<double>{points(i, 0), points(i, 1)}, true);
      value[2 * i] = hanging.strand[kLeft].*shown.member;
      value[2 * i + 1] = hanging.strand[kRight].*shown.member;
    }
    result[shown.name] = array;
  }
  return result;
}

/// Verdicts (n,), tensions (n, 2) [N] and compliance (n, 2, 2) [mm/N] of places (n, 2) [mm].
nb::dict reachOf(const Values& values, bool over_top, const Pairs& points, double least_free) {
  const Machine<double> machine = machineOf(numbers<double>(values), over_top);
  ReachLimits<double> limits;
  limits.least_free = least_free;
  uint8_t* verdict;
  double *tension, *give;
  const size_t count = points.shape(0);
  nb::dict result;
  result["verdict"] = newArray<uint8_t>({count}, &verdict);
  result["tension"] = newArray<double>({count, 2}, &tension);
  result["compliance"] = newArray<double>({count, 2, 2}, &give);
  for (size_t i = 0; i < count; ++i) {
    const Reached<double> here = reach(machine, Point<double>{points(i, 0), points(i, 1)}, limits);
    verdict[i] = static_cast<uint8_t>(here.verdict);
    std::copy_n(here.tension, 2, tension + 2 * i);
    const double matrix[4] = {here.give.xx, here.give.xy, here.give.xy, here.give.yy};
    std::copy_n(matrix, 4, give + 4 * i);
  }
  return result;
}

/// The default limits of reach().
nb::dict reachLimits() {
  const ReachLimits<double> usual;
  return dictOf({{"most_tension", usual.most_tension},
                 {"least_tension", usual.least_tension},
                 {"least_free", usual.least_free},
                 {"most_give", usual.most_give}});
}

}  // namespace

NB_MODULE(_core, module) {
  module.doc() = "The kinematics that are flashed, as numpy functions; mm, N, rad.";
  module.def("lengths", &lengths, nb::arg("values"), nb::arg("over_top"), nb::arg("points"),
             nb::arg("float32") = false,
             "Chain paid out (n, 2) [mm] for places (n, 2) [mm], and found (n,): 0 is yes.");
  module.def("places", &places, nb::arg("values"), nb::arg("over_top"), nb::arg("chains"),
             "Places (n, 2) [mm] for chains (n, 2) [mm], and found (n,): 0 is yes.");
  module.def("slopes", &slopes, nb::arg("values"), nb::arg("over_top"), nb::arg("points"),
             "Exact slopes of lengths by setting (n, 2, m), by place (n, 2, 2), found (n,).");
  module.def("strands", &strands, nb::arg("values"), nb::arg("over_top"), nb::arg("points"),
             "Each strand's free length, direction, tension, straight and extra chain, (n, 2).");
  const ReachLimits<double> usual;
  module.def(
      "reach", &reachOf, nb::arg("values"), nb::arg("over_top"), nb::arg("points"), nb::kw_only(),
      nb::arg("least_free") = usual.least_free,
      "Where places (n, 2) [mm] are usable: verdict (n,) (0 usable, 1 too tight, 2 too slack,\n"
      "3 too vertical, 4 cannot hang), tension (n, 2) [N] of left and right chain at its\n"
      "sprocket, compliance (n, 2, 2) [mm/N] of the sled, [[xx, xy], [xy, yy]].");
  module.def(
      "reach_limits", &reachLimits,
      "The usual limits: most_tension and least_tension [N], least_free [mm] of chain between\n"
      "ring and sprocket, most_give [mm/N] in the direction in which the sled gives most.");
  addEffects(module);
  addSettings(module);
}
