// The dump of all settings, and setting a value.
#include "parts.h"

namespace machine {
namespace {

/// Puts letters on the wire, for texts of settings that come letter by letter.
struct PutLetter {
  Printer& out;
  void operator()(char letter) { out << letter; }
};

/// A number of Grbl's: another name of a setting, or one that never changes.
struct GrblSetting {
  uint8_t number;
  Setting setting;
  uint8_t fixed;  ///< where `setting` is kSettingCount

  bool isFixed() const { return setting == kSettingCount; }
};

const GrblSetting kForGrbl[] PROGMEM = {
    {10, kSettingCount, 1},     // the status says machine places
    {13, kReportInches, 0},     //
    {20, kSettingCount, 0},     // the sheet's edge always stops the sled
    {21, kSettingCount, 0},     // no limit switches
    {22, kSettingCount, 0},     // no homing
    {30, kSpindleMost, 0},      //
    {31, kSpindleLeast, 0},     //
    {32, kSettingCount, 0},     // a laser is switched by M106
    {110, kGreatestFeed, 0},    //
    {111, kGreatestFeed, 0},    //
    {120, kAccelerationXy, 0},  //
    {121, kAccelerationXy, 0},  //
    {122, kAccelerationZ, 0},   //
    {130, kSheetWidth, 0},      //
    {131, kSheetHeight, 0},     //
};
const uint8_t kGrblCount = sizeof kForGrbl / sizeof kForGrbl[0];

GrblSetting grblAt(uint8_t index) {
  GrblSetting row;
  memcpy_P(&row, kForGrbl + index, sizeof row);
  return row;
}

}  // namespace

bool SettingsLines::run(const char* line) {
  const char* const text = line + 1;
  if (*text == '\0') {
    parts_.out.line(
        FLASH("$$ shows all settings, $n=value sets one, $RST=$ or # or * restores defaults"));
    return true;
  }
  if (!parts_.waiting.drain()) return false;
  if (*text == '$') {
    if (text[1] != '\0') return parts_.answers.refuseStatement();
    dump();
    return true;
  }
  if (text[0] == '#' && text[1] == '\0') {
    parts_.coordinates.show();
    return true;
  }
  if (strncmp_P(text, PSTR("RST="), 4) == 0) return reset(text + 4);
  return set(text);
}

bool SettingsLines::reset(const char* what) {
  using settings::Reset;
  const bool is_known = (what[0] == '$' || what[0] == '#' || what[0] == '*') && what[1] == '\0';
  if (!is_known) return parts_.answers.refuseStatement();
  if (what[0] == '#' && parts_.out.speaksGrbl()) {
    parts_.coordinates.forget();
    return true;
  }
  restoreDefaults(what[0] == '$'   ? Reset::kSettings
                  : what[0] == '#' ? Reset::kSettingsAndPosition
                                   : Reset::kEverything);
  return true;
}

void SettingsLines::restoreDefaults(settings::Reset what) {
  parts_.out.line(FLASH("Message: Restoring defaults "));
  parts_.spindle.switchLaser(false);
  parts_.memory.reset(what);
  const bool forgets_position = what != settings::Reset::kSettings;
  if (forgets_position) {
    parts_.axes.setCounts(0, 0, 0);
    parts_.keeper.startAfresh();
  }
  parts_.axes.simulate(parts_.values.at(kSimulatedMotors) != 0);
  parts_.new_values.take(NewValues::kAll);
  parts_.greeting.sayBoard();
  parts_.greeting.sayMotors(parts_.axes.isSimulated());
  parts_.greeting.sayReady();
  parts_.answers.setAnswered(true);
  if (!forgets_position) return;
  parts_.new_values.prepareGeometry();
  parts_.place.search(Search::kErased);
  parts_.place.sayUnset(true);
}

void SettingsLines::dump(uint16_t first) {
  PutLetter put = {parts_.out};
  const bool speaks_grbl = parts_.out.speaksGrbl();
  for (uint8_t i = 0; i < parts_.values.count(); ++i) {
    if (parts_.values.table().at(i).access != settings::Access::kListed) continue;
    settings::putSetting(parts_.values, i, first, put);
    parts_.out.end();
    // Everything else goes on meanwhile; a stop ends the dump.
    parts_.waiting.service();
    if (parts_.waiting.isStopping()) return;
    // A sender that takes the lines of both for one table keeps wrong numbers.
    if (parts_.out.speaksGrbl() != speaks_grbl) return dumpForGrbl();
  }
}

void SettingsLines::dumpForGrbl() {
  sayGrblNumbers();
  dump(kFirstForGrbl);
}

void SettingsLines::sayGrblNumbers() {
  PutLetter put = {parts_.out};
  for (uint8_t i = 0; i < kGrblCount; ++i) {
    const GrblSetting row = grblAt(i);
    parts_.out << '$' << int32_t(row.number) << '=';
    settings::putNumber(row.isFixed() ? row.fixed : parts_.values.at(row.setting), put);
    parts_.out.end();
  }
}

bool SettingsLines::setForGrbl(const char* text) {
  float number, value;
  if (!read(text, number, value)) return false;
  if (number >= kFirstForGrbl && number <= kFirstForGrbl + 255)
    return setValue(uint8_t(number - kFirstForGrbl), value, kFirstForGrbl);
  for (uint8_t i = 0; i < kGrblCount; ++i) {
    const GrblSetting row = grblAt(i);
    if (float(row.number) != number) continue;
    if (!row.isFixed())
      return setValue(parts_.values.table().at(row.setting).number, value, kFirstForGrbl);
    return value == row.fixed ||
           parts_.answers.refuse(FLASH("this machine cannot change that number of Grbl's"));
  }
  return parts_.answers.refuse(
      FLASH("this machine has no such number; its settings begin at $1000"));
}

bool SettingsLines::set(const char* text) {
  float number, value;
  if (!read(text, number, value)) return false;
  if (!(number >= 0 && number <= 255)) return parts_.answers.refuseStatement();
  return setValue(uint8_t(number), value, 0);
}

bool SettingsLines::read(const char* text, float& number, float& value) {
  // The published firmware passes over a letter in front of a number.
  if (*text >= 'A' && *text <= 'Z') ++text;
  const gcode::Number left = gcode::readNumber(text);
  const bool has_number = left.fault == gcode::Fault::kNone && *text == '=';
  if (has_number) ++text;
  const gcode::Number right = gcode::readNumber(text);
  if (!has_number || right.fault != gcode::Fault::kNone || *text != '\0')
    return parts_.answers.refuse(FLASH("Bad number format"), grbl::kBadNumber);
  if (!(left.value >= 0 && left.value < 2000) || left.value != float(uint16_t(left.value)))
    return parts_.answers.refuseStatement();
  number = left.value;
  value = right.value;
  return true;
}

bool SettingsLines::setValue(uint8_t number, float value, uint16_t first) {
  const settings::Table& table = parts_.values.table();
  const uint8_t meant = meantBy(number);
  if (meant == table.at(kChainSpeed).number && value > Planner::mostChainSpeed(parts_.values))
    return refuseChainSpeed();
  const settings::Refusal refusal = parts_.memory.set(meant, value);
  if (refusal == settings::Refusal::kNone) {
    parts_.new_values.take(table.at(settings::indexOf(table, meant)).touches);
    return true;
  }
  parts_.answers.beginError();
  PutLetter put = {parts_.out};
  settings::putRefusal(table, number, refusal, first, put);
  parts_.out.end();
  return false;
}

bool SettingsLines::refuseChainSpeed() {
  parts_.answers.beginError();
  parts_.out << FLASH("$68 must be at most ");
  parts_.out.fixed(Planner::mostChainSpeed(parts_.values), 0);
  parts_.out.line(FLASH(": the gearbox turns a sprocket 20 times a minute at most"));
  return false;
}

}  // namespace machine
