// The library of effects for Python: texts, traits, and each effect in the judge's numbers.
#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>

#include <map>
#include <string>
#include <vector>

#include "arrays.h"
#include "bindings.h"
#include "judged.h"

namespace nb = nanobind;
using namespace kinematics;

namespace {

/// Collects a machine in the judge's numbers, as setJudge() sets them.
struct Judged {
  std::map<std::string, double> numbers, factors;

  void set(const char* name, double value) { numbers[name] = value; }
  void scale(const char* name, double factor) {
    factors.insert({name, 1.0}).first->second *= factor;
  }
};

std::map<std::string, double> judged(const core::Values& values, bool over_top) {
  const std::vector<double> plain = core::numbers<double>(values);
  const core::Described<double> machine = core::describedBy(plain, over_top);
  Judged judge;
  setJudge(machine.frame, machine.effects, judge);
  for (const auto& [name, factor] : judge.factors) judge.numbers.at(name) *= factor;
  return judge.numbers;
}

/// Sizes of effects to expect on a machine when only its frame is known.
struct Usual {
  const Frame<double>& frame;
  nb::dict sizes;

  template <class ThisEffect>
  void effect(int) {
    for (uint8_t i = 0; i < ThisEffect::kParamCount; ++i) {
      const double size = ThisEffect::usual(frame, i);
      const std::string name =
          std::string(ThisEffect::info().name) + "." + ThisEffect::param(i).name;
      if (size != 0) sizes[name.c_str()] = size;
    }
  }
};

nb::dict usual(const core::Values& values, bool over_top) {
  const Frame<double> frame = core::describedBy(core::numbers<double>(values), over_top).frame;
  Usual each = {frame, {}};
  Effects::For<double>::visit(each);
  return each.sizes;
}

nb::object checkOf(const CheckInfo& info) {
  if (!info.title || !*info.title) return nb::none();
  return dictOf({{"title", info.title},
                 {"steps", info.steps},
                 {"value", info.value},
                 {"minutes", info.minutes}});
}

template <class ThisEffect>
nb::list examplesOf() {
  nb::list examples;
  for (uint8_t i = 0; i < ThisEffect::kExampleCount; ++i) {
    const Example shown = ThisEffect::example(i);
    if (!shown.label) continue;
    nb::dict sizes;
    for (uint8_t k = 0; k < ThisEffect::kParamCount; ++k)
      sizes[ThisEffect::param(k).name] = shown.size[k];
    examples.append(dictOf({{"label", shown.label}, {"sizes", sizes}, {"most", shown.most}}));
  }
  return examples;
}

const char* const kCurves[] = {"straight", "square", "tangent squared"};  // by Curve

nb::object readingOf(const ReadingInfo& info) {
  if (!*info.title) return nb::none();
  return dictOf({{"title", info.title},
                 {"unit", info.unit},
                 {"usual", info.usual},
                 {"factor", info.factor},
                 {"digits", info.digits},
                 {"zero", info.zero},
                 {"curve", kCurves[info.curve]}});
}

const char* const kShown[] = {"as is", "root", "angle"};  // by Shown

nb::object plainOf(const PlainInfo& info) {
  if (!*info.more) return nb::none();
  return dictOf({{"more", info.more},
                 {"less", info.less},
                 {"unit", info.unit},
                 {"times", info.times},
                 {"shown", kShown[info.shown]}});
}

template <class ThisEffect>
nb::dict parameterOf(int first_setting, uint8_t i) {
  const ParamInfo param = ThisEffect::param(i);
  const PublishedInfo published = ThisEffect::published(i);
  nb::object carried = nb::none();
  if (published.number) carried = nb::make_tuple(published.number, published.factor);
  return dictOf({{"name", param.name},
                 {"setting", first_setting + i},
                 {"unit", param.unit},
                 {"low", param.low},
                 {"high", param.high},
                 {"typical", param.typical},
                 {"summary", param.summary},
                 {"sigma", param.sigma},
                 {"plain", plainOf(ThisEffect::plain(i))},
                 {"reading", readingOf(ThisEffect::reading(i))},
                 {"published", carried}});
}

struct Lister {
  nb::list effects;

  template <class ThisEffect>
  void effect(int first_setting) {
    const EffectInfo info = ThisEffect::info();
    nb::list parameters;
    for (uint8_t i = 0; i < ThisEffect::kParamCount; ++i)
      parameters.append(parameterOf<ThisEffect>(first_setting, i));
    effects.append(dictOf({{"name", info.name},
                           {"noun", *ThisEffect::noun() ? ThisEffect::noun() : info.name},
                           {"where", "firmware"},
                           {"summary", info.summary},
                           {"pattern", info.pattern},
                           {"look_alikes", info.look_alikes},
                           {"remedy", info.remedy},
                           {"empirical", bool(ThisEffect::kEmpirical)},
                           {"per_zeroing", bool(ThisEffect::kPerZeroing)},
                           {"in_frame", bool(ThisEffect::kInFrame)},
                           {"weight_power", int(ThisEffect::kWeightPower)},
                           {"check", checkOf(ThisEffect::check())},
                           {"examples", examplesOf<ThisEffect>()},
                           {"parameters", parameters}}));
  }
};

nb::list effects() {
  Lister lister;
  Effects::For<double>::visit(lister);
  return lister.effects;
}

/// The frame's numbers, in the order in which they begin the array of values.
nb::list frame() {
  nb::list result;
  for (int i = 0; i < kFrameFieldCount; ++i) {
    const FrameField<double>& field = frameFields<double>()[i];
    result.append(dictOf({{"name", field.name},
                          {"unit", field.unit},
                          {"usual", field.usual},
                          {"low", field.low},
                          {"high", field.high},
                          {"summary", field.summary},
                          {"noun", field.noun}}));
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

void addEffects(nb::module_& module) {
  module.def("frame", &frame, "The frame's numbers: name, unit, usual, low, high, summary.");
  module.def("effects", &effects, "The library of effects, in the order they are applied.");
  module.def("settings", &settings, "Names of the values array, in order.");
  module.def(
      "judged", &judged, nb::arg("values"), nb::arg("over_top"),
      "The machine in the numbers of the judge, by name (see tools/judge/reference/numbers.h).");
  module.def("usual", &usual, nb::arg("values"), nb::arg("over_top"),
             "Sizes of parameters that every machine with this frame has, by full name.");
}
