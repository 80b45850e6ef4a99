// The dump of all settings, and setting a value.
#include "settings_lines.h"

namespace machine {
namespace {

/// Puts letters on the wire, for texts of settings that come letter by letter.
struct PutLetter {
  Printer& out;
  void operator()(char letter) { out << letter; }
};

}  // namespace

void SettingsLines::dump() {
  PutLetter put = {out_};
  for (uint8_t i = 0; i < values_.count(); ++i) {
    if (values_.table().at(i).access != settings::Access::kListed) continue;
    settings::putSetting(values_, i, put);
    out_.end();
    // Whatever else goes on, goes on; a stop ends the dump.
    waiting_.service();
    if (waiting_.isStopping()) return;
  }
}

bool SettingsLines::set(const char* text) {
  // The published firmware passes over a letter in front of a number.
  if (*text >= 'A' && *text <= 'Z') ++text;
  const gcode::Number number = gcode::readNumber(text);
  const bool has_number = number.fault == gcode::Fault::kNone && *text == '=';
  if (has_number) ++text;
  const gcode::Number value = gcode::readNumber(text);
  if (!has_number || value.fault != gcode::Fault::kNone || *text != '\0')
    return answers_.refuse(FLASH("Bad number format"));
  if (!(number.value >= 0 && number.value <= 255) || number.value != float(uint8_t(number.value)))
    return answers_.refuseStatement();
  return setValue(uint8_t(number.value), value.value);
}

bool SettingsLines::setValue(uint8_t number, float value) {
  const settings::Table& table = values_.table();
  const uint8_t meant = meantBy(number);
  if (meant == table.at(kChainSpeed).number && value > Planner::mostChainSpeed(values_))
    return refuseChainSpeed();
  const settings::Refusal refusal = memory_.set(meant, value);
  if (refusal == settings::Refusal::kNone) {
    new_values_.take(table.at(settings::indexOf(table, meant)).touches);
    return true;
  }
  answers_.beginError();
  PutLetter put = {out_};
  settings::putRefusal(table, number, refusal, put);
  out_.end();
  return false;
}

bool SettingsLines::refuseChainSpeed() {
  answers_.beginError();
  out_ << FLASH("$68 must be at most ");
  out_.fixed(Planner::mostChainSpeed(values_), 0);
  out_.line(FLASH(": the gearbox turns a sprocket 20 times a minute at most"));
  return false;
}

}  // namespace machine
