// What a line with a `$` does: the dump, a new value, the reset; and what follows a new value.
#include "machine.h"

namespace machine {
namespace {

/// Letters to the wire, for what the settings put letter by letter.
struct PutLetter {
  Printer& out;
  void operator()(char letter) { out << letter; }
};

const uint32_t kQuietMs = 700;  // clients send their settings about 20 a second
const uint8_t kEverything = 255;

}  // namespace

bool Machine::runSetting(const char* line) {
  const char* at = line + 1;
  if (*at == '\0') {
    out_.line(
        FLASH("$$ shows all settings, $n=value sets one, $RST=$ or # or * restores defaults"));
    return true;
  }
  if (!drain()) return false;
  if (*at == '$') {
    if (at[1] != '\0') return refuse(FLASH("Invalid statement"));
    dumpSettings();
    return true;
  }
  if (at[0] == '#' && at[1] == '\0') {
    showCoordinates();
    return true;
  }
  if (strncmp_P(at, PSTR("RST="), 4) == 0) return runReset(at + 4);
  // The published firmware passes over one other character in front of a number.
  if (*at >= 'A' && *at <= 'Z') ++at;
  const gcode::Number number = gcode::readNumber(at);
  if (number.fault != gcode::Fault::kNone || *at != '=') return refuse(FLASH("Bad number format"));
  ++at;
  const gcode::Number value = gcode::readNumber(at);
  if (value.fault != gcode::Fault::kNone || *at != '\0') return refuse(FLASH("Bad number format"));
  if (!(number.value >= 0 && number.value <= 255) || number.value != float(uint8_t(number.value)))
    return refuse(FLASH("Invalid statement"));
  return setValue(uint8_t(number.value), value.value);
}

bool Machine::runReset(const char* what) {
  if (what[0] == '\0' || what[1] != '\0') return refuse(FLASH("Invalid statement"));
  switch (what[0]) {
    case '$':
      restoreDefaults(settings::Reset::kSettings);
      return true;
    case '#':
      restoreDefaults(settings::Reset::kSettingsAndPosition);
      return true;
    case '*':
      restoreDefaults(settings::Reset::kEverything);
      return true;
    default:
      return refuse(FLASH("Invalid statement"));
  }
}

void Machine::dumpSettings() {
  PutLetter put = {out_};
  for (uint8_t i = 0; i < values_.count(); ++i) {
    if (table_.at(i).access != settings::Access::kListed) continue;
    settings::putSetting(values_, i, put);
    out_.end();
    reportWhenDue();
    clock_.idle();
  }
}

bool Machine::setValue(uint8_t number, float value) {
  const uint8_t meant = meantBy(number);
  if (meant == table_.at(kChainSpeed).number && value > Mover::mostChainSpeed(values_))
    return refuseChainSpeed();
  const settings::Refusal refusal = memory_.set(meant, value);
  if (refusal == settings::Refusal::kNone) {
    takeOver(table_.at(settings::indexOf(table_, meant)).touches);
    return true;
  }
  beginError();
  PutLetter put = {out_};
  settings::putRefusal(table_, number, refusal, put);
  out_.end();
  return false;
}

bool Machine::refuseChainSpeed() {
  beginError();
  out_ << FLASH("$68 must be at most ");
  out_.fixed(Mover::mostChainSpeed(values_), 0);
  out_.line(FLASH(": the gearbox turns a sprocket 20 times a minute at most"));
  return false;
}

void Machine::takeOver(uint8_t touches) {
  using namespace settings;
  if (touches & kDrives) arrangeDrives();
  if ((touches & (kScale | kLoops)) && axes_.prepare(values_)) keeper_.reconsider();
  if (touches & kLimits) mover_.prepare(values_, axes_.secondsPerTick());
  if (touches & kCutter) cutter_.off();
  if (!(touches & kGeometry)) return;
  // The clients send many in a row: the place is searched once, after the last.
  is_geometry_stale_ = true;
  geometry_changed_ms_ = clock_.milliseconds();
}

void Machine::arrangeDrives() {
  axes_.releaseAll();
  // A tick in between would take another wiring of the encoders for motion.
  const WithoutTicks hold(clock_);
  drives_.arrange(values_.at(kFeedSide) == 1, uint8_t(values_.at(kPwmFrequency)));
  axes_.forgetRawCounts();
}

void Machine::refreshGeometry() {
  if (!is_geometry_stale_) return;
  is_geometry_stale_ = false;
  geometry_.prepare(values_);
  mover_.setGeometry(geometry_);
  searchPlace();
  keeper_.reconsider();
}

void Machine::refreshGeometryWhenQuiet() {
  if (!is_geometry_stale_ || isMoving() || clock_.milliseconds() - geometry_changed_ms_ < kQuietMs)
    return;
  refreshGeometry();
  if (keeper_.trustsChains()) findPlace();
}

void Machine::restoreDefaults(settings::Reset what) {
  out_.line(FLASH("Message: Restoring defaults "));
  switchLaser(false);
  memory_.reset(what);
  if (what != settings::Reset::kSettings) {
    axes_.setCounts(0, 0, 0);
    keeper_.startAfresh();
  }
  axes_.simulate(values_.at(kSimulatedMotors) != 0);
  takeOver(kEverything);
  greet();
  sayMotors();
  sayReady();
  is_answered_ = true;
  if (what == settings::Reset::kSettings) return;
  geometry_.prepare(values_);
  is_geometry_stale_ = false;
  searchPlace();
  sayUnset(true);
}

}  // namespace machine
