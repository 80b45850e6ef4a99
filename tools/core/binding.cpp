// lib/Kinematics seen from Python: arrays in, arrays out, no physics of its own.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <string>
#include <vector>

#include "dual.h"
// The definitions, not only the declarations: they are instantiated here for dual numbers too.
#include "Kinematics.cpp"
#include "frame_info.h"
#include "reach.cpp"
#include "settings_binding.h"

namespace nb = nanobind;
using namespace kinematics;

namespace {

enum { kSettingCount = kFrameFieldCount + kEffectParamCount, kInputCount = kSettingCount + 2 };
using Slopes = dual::Dual<kInputCount>;

using Values = nb::ndarray<const double, nb::shape<-1>, nb::c_contig, nb::device::cpu>;
using Pairs = nb::ndarray<const double, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;

/// A new numpy array of zeros that owns its memory.
template <class Number>
nb::ndarray<nb::numpy, Number> newArray(std::vector<size_t> shape, Number** data) {
  size_t size = 1;
  for (size_t n : shape) size *= n;
  *data = new Number[size]();
  nb::capsule owner(*data, [](void* p) noexcept { delete[] static_cast<Number*>(p); });
  return nb::ndarray<nb::numpy, Number>(*data, shape.size(), shape.data(), owner);
}

template <class Real>
Machine<Real> machineOf(const std::vector<Real>& values, bool over_top) {
  Frame<Real> frame;
  for (int i = 0; i < kFrameFieldCount; ++i) frame.*frameFields<Real>()[i].member = values[i];
  frame.feed = over_top ? Feed::kOverTop : Feed::kOffBottom;
  EffectParams<Real> effects;
  std::copy(values.begin() + kFrameFieldCount, values.end(), effects.value);
  return prepare(frame, effects);
}

template <class Real>
std::vector<Real> numbers(const Values& values) {
  if (values.shape(0) != kSettingCount)
    throw nb::value_error("values must hold one number for each entry of settings()");
  std::vector<Real> result;
  for (size_t i = 0; i < kSettingCount; ++i) result.push_back(static_cast<Real>(values(i)));
  return result;
}

template <class Real>
nb::tuple lengthsOf(const Values& values, bool over_top, const Pairs& points) {
  const Machine<Real> machine = machineOf(numbers<Real>(values), over_top);
  double* length;
  uint8_t* found;
  const size_t count = points.shape(0);
  auto lengths = newArray<double>({count, 2}, &length);
  auto founds = newArray<uint8_t>({count}, &found);
  for (size_t i = 0; i < count; ++i) {
    const PaidOut<Real> paid = inverse(
        machine, Point<Real>{static_cast<Real>(points(i, 0)), static_cast<Real>(points(i, 1))});
    length[2 * i] = static_cast<double>(paid.chains.left);
    length[2 * i + 1] = static_cast<double>(paid.chains.right);
    found[i] = static_cast<uint8_t>(paid.found);
  }
  return nb::make_tuple(lengths, founds);
}

nb::tuple lengths(const Values& values, bool over_top, const Pairs& points, bool float32) {
  return float32 ? lengthsOf<float>(values, over_top, points)
                 : lengthsOf<double>(values, over_top, points);
}

nb::tuple places(const Values& values, bool over_top, const Pairs& chains) {
  const Machine<double> machine = machineOf(numbers<double>(values), over_top);
  double* place;
  uint8_t* found;
  const size_t count = chains.shape(0);
  auto result = newArray<double>({count, 2}, &place);
  auto founds = newArray<uint8_t>({count}, &found);
  for (size_t i = 0; i < count; ++i) {
    Place<double> at = forward(machine, Chains<double>{chains(i, 0), chains(i, 1)});
    // The board stops within a few micrometres; another start from there leaves nothing.
    if (at.found == Found::kYes)
      at = forward(machine, Chains<double>{chains(i, 0), chains(i, 1)}, at.sled);
    place[2 * i] = at.sled.x;
    place[2 * i + 1] = at.sled.y;
    found[i] = static_cast<uint8_t>(at.found);
  }
  return nb::make_tuple(result, founds);
}

/// (slopes by setting (n, 2, settings), slopes by place (n, 2, 2), found (n,))
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

/// What sketches of new effects may look at: each (n, 2), left and right.
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
nb::dict reachOf(const Values& values, bool over_top, const Pairs& points, double most_tension,
                 double least_tension, double least_free, double most_give) {
  const Machine<double> machine = machineOf(numbers<double>(values), over_top);
  ReachLimits<double> limits;
  limits.most_tension = most_tension;
  limits.least_tension = least_tension;
  limits.least_free = least_free;
  limits.most_give = most_give;
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
    const double own[4] = {here.give.xx, here.give.xy, here.give.xy, here.give.yy};
    std::copy_n(own, 4, give + 4 * i);
  }
  return result;
}

/// The limits of reach() that stand if none are given.
nb::dict reachLimits() {
  const ReachLimits<double> usual;
  nb::dict result;
  result["most_tension"] = usual.most_tension;
  result["least_tension"] = usual.least_tension;
  result["least_free"] = usual.least_free;
  result["most_give"] = usual.most_give;
  return result;
}

struct Lister {
  nb::list effects;

  template <class Own>
  void effect(int first_setting) {
    const EffectInfo info = Own::info();
    nb::list parameters;
    for (uint8_t i = 0; i < Own::kParamCount; ++i) {
      const ParamInfo param = Own::param(i);
      nb::dict entry;
      entry["name"] = param.name;
      entry["setting"] = first_setting + i;
      entry["unit"] = param.unit;
      entry["low"] = param.low;
      entry["high"] = param.high;
      entry["typical"] = param.typical;
      entry["summary"] = param.summary;
      parameters.append(entry);
    }
    nb::dict entry;
    entry["name"] = info.name;
    entry["summary"] = info.summary;
    entry["pattern"] = info.pattern;
    entry["look_alikes"] = info.look_alikes;
    entry["remedy"] = info.remedy;
    entry["parameters"] = parameters;
    effects.append(entry);
  }
};

nb::list effects() {
  Lister lister;
  Effects::For<double>::visit(lister);
  return lister.effects;
}

/// The frame's numbers, in the order in which they lead the values array.
nb::list frame() {
  nb::list result;
  for (int i = 0; i < kFrameFieldCount; ++i) {
    const FrameField<double>& field = frameFields<double>()[i];
    nb::dict entry;
    entry["name"] = field.name;
    entry["unit"] = field.unit;
    entry["usual"] = field.usual;
    entry["low"] = field.low;
    entry["high"] = field.high;
    entry["summary"] = field.summary;
    result.append(entry);
  }
  return result;
}

nb::list settings() {
  nb::list names;
  for (nb::handle field : frame()) names.append(field["name"]);
  for (nb::handle effect : effects())
    for (nb::handle param : effect["parameters"])
      names.append(nb::str("{}.{}").format(effect["name"], param["name"]));
  return names;
}

}  // namespace

NB_MODULE(_core, module) {
  module.doc() = "The kinematics that are flashed, as numpy functions; mm, N, rad.";
  module.def("frame", &frame, "The frame's numbers: name, unit, usual, low, high, summary.");
  module.def("effects", &effects, "The library of effects, in the order they are applied.");
  module.def("settings", &settings, "Names of the values array, in order.");
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
      nb::arg("most_tension") = usual.most_tension, nb::arg("least_tension") = usual.least_tension,
      nb::arg("least_free") = usual.least_free, nb::arg("most_give") = usual.most_give,
      "Where places (n, 2) [mm] are usable: verdict (n,) (0 usable, 1 too tight, 2 too slack,\n"
      "3 too vertical, 4 cannot hang), tension (n, 2) [N] of left and right chain at its\n"
      "sprocket, compliance (n, 2, 2) [mm/N] of the sled, [[xx, xy], [xy, yy]].");
  module.def(
      "reach_limits", &reachLimits,
      "The usual limits: most_tension and least_tension [N], least_free [mm] of chain between\n"
      "ring and sprocket, most_give [mm/N] in the direction in which the sled gives most.");
  addSettings(module);
}
