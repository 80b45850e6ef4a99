// The firmware's table of settings for Python: rows, texts, and what the numbers mean together.
#include <nanobind/stl/map.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "../../src/carried_twice.h"
#include "../../src/effective.h"
#include "../../src/settings_flash.h"
#include "bindings.h"
#include "frame_info.h"

namespace nb = nanobind;
using namespace settings;

namespace {

using Room = std::array<float, kSettingCount>;

const char* const kKinds[] = {"bool", "u8", "u16", "float"};
const char* const kAccesses[] = {"listed", "hidden", "kept"};

/// Texts about a row.
struct RowText {
  const char* label;  ///< "name, unit"
  const char* key;    ///< section and key of the published programs, or ""
  const char* sentence;
  const char* change;  ///< difference from the published firmware, or ""
};

#define PLUMB_TEXT(name, number, label, kind, step, usual, low, high, touches, key, sentence, \
                   change)                                                                    \
  {label, key, sentence, change},
const RowText kTexts[] = {PLUMB_SETTINGS(PLUMB_TEXT, PLUMB_TEXT, PLUMB_TEXT)};
#undef PLUMB_TEXT

nb::dict textsOf(const std::string& name, const std::string& unit, const char* key,
                 const std::string& sentence, const char* change) {
  return dictOf(
      {{"name", name}, {"unit", unit}, {"key", key}, {"sentence", sentence}, {"change", change}});
}

/// Texts of effects' parameters by their $-number.
struct EffectTexts {
  std::map<int, nb::dict> rows;

  template <class ThisEffect>
  void effect(int first_setting) {
    for (uint8_t i = 0; i < ThisEffect::kParamCount; ++i) {
      const kinematics::ParamInfo param = ThisEffect::param(i);
      rows[first_setting + i] = textsOf(std::string(ThisEffect::info().name) + "." + param.name,
                                        param.unit, "", param.summary, "new");
    }
  }
};

nb::dict ownTexts(uint8_t index) {
  const RowText& text = kTexts[index];
  const std::string label = text.label;
  const size_t comma = label.find(", ");
  const std::string unit = comma == std::string::npos ? "" : label.substr(comma + 2);
  return textsOf(label.substr(0, comma), unit, text.key, text.sentence, text.change);
}

/// `g54_x` to `g59_z`, `g28_x` to `g30_z`.
nb::dict placeTexts(uint8_t index) {
  const int place = index / kPlaceAxes;
  const std::string axis(1, "xyz"[index % kPlaceAxes]);
  const bool is_goal = place >= kKeptSystems;
  const std::string code = std::to_string(is_goal ? 28 + 2 * (place - kKeptSystems) : 54 + place);
  const char* const sentence =
      is_goal ? "where G28 and G30 go, set by G28.1 and G30.1; 20000: nowhere yet"
              : "origin of G54 to G59, set by G10 L2 and L20";
  return textsOf("g" + code + "_" + axis, "mm", "", sentence, "new");
}

/// Names of the parts that a new value touches.
nb::list touchesOf(const Entry& entry) {
  const char* const kWords[] = {"scale",  "geometry", "loops",  "limits",
                                "drives", "cutter",   "restart"};
  nb::list result;
  for (int bit = 0; bit < 7; ++bit)
    if (entry.touches & (1 << bit)) result.append(kWords[bit]);
  return result;
}

nb::list table() {
  const FlashTable rows;
  EffectTexts effects;
  kinematics::Effects::For<float>::visit(effects);
  nb::list result;
  for (uint8_t i = 0; i < rows.count(); ++i) {
    const Entry entry = rows.at(i);
    nb::dict row = i < kFirstEffectSetting  ? ownTexts(i)
                   : i < kFirstPlaceSetting ? effects.rows.at(entry.number)
                                            : placeTexts(uint8_t(i - kFirstPlaceSetting));
    row["number"] = entry.number;
    row["kind"] = kKinds[int(entry.kind)];
    row["access"] = kAccesses[int(entry.access)];
    row["usual"] = entry.usual;
    row["low"] = entry.low;
    row["high"] = entry.high;
    row["step"] = entry.step;
    row["touches"] = touchesOf(entry);
    result.append(row);
  }
  return result;
}

/// Sets values from {number: value}. A refusal throws with the firmware's message.
void setAll(Values& values, const std::map<int, double>& given) {
  for (const auto& [number, value] : given) {
    if (number < 0 || number > 255)
      throw nb::value_error(("$" + std::to_string(number) + " is no setting").c_str());
    const Refusal why = values.set(meantBy(uint8_t(number)), float(value));
    if (why == Refusal::kNone) continue;
    std::string text;
    const auto put = [&](char c) { text += c; };
    putRefusal(values.table(), meantBy(uint8_t(number)), why, 0, put);
    throw nb::value_error(text.c_str());
  }
}

/// Frame and effects that the firmware computes with for these settings; the others are at their
/// defaults.
nb::dict effective(const std::map<int, double>& given) {
  const FlashTable rows;
  Room room;
  Values values(rows, room.data());
  setAll(values, given);
  const Geometry geometry = geometryOf(values);
  nb::dict frame, effects;
  for (int i = 0; i < kinematics::kFrameFieldCount; ++i) {
    const kinematics::FrameField<float>& field = kinematics::frameFields<float>()[i];
    frame[field.name] = geometry.frame.*field.member;
  }
  EffectTexts texts;
  kinematics::Effects::For<float>::visit(texts);
  int index = 0;
  for (auto& [number, row] : texts.rows) effects[row["name"]] = geometry.effects.value[index++];
  const bool over_top = geometry.frame.feed == kinematics::Feed::kOverTop;
  return dictOf({{"frame", frame}, {"effects", effects}, {"over_top", over_top}});
}

/// The $-numbers of corrections that are set twice: by a published number and by an effect.
std::vector<std::pair<int, int>> carriedTwice(const std::map<int, double>& given) {
  const FlashTable rows;
  Room room;
  Values values(rows, room.data());
  setAll(values, given);
  std::vector<std::pair<int, int>> result;
  for (uint8_t i = 0; carriersOf(i).published != 0; ++i) {
    const Carriers carriers = carriersOf(i);
    if (areBothSet(values, carriers)) result.emplace_back(carriers.published, carriers.ours);
  }
  return result;
}

std::string format(double value) { return formatValue(float(value)).text; }

}  // namespace

void addSettings(nb::module_& module) {
  module.def("settings_table", &table,
             "The firmware's settings in the order of its dump: number, name, unit, kind, access,\n"
             "usual, low, high, step, touches, key of the published programs, sentence, change.");
  module.def("effective", &effective, nb::arg("settings"),
             "Frame, effects and over_top [mm, N, rad] that the firmware computes with, given\n"
             "{number: value} for what is not at its default.");
  module.def("carried_twice", &carriedTwice, nb::arg("settings"),
             "The corrections that both a published number and ours carry, given {number: value}\n"
             "for what is not at its default: pairs of $-numbers that the firmware adds.");
  module.def("format_value", &format, nb::arg("value"), "A value as the firmware's dump has it.");
}
