// What a sender of Grbl asks for: the status at each `?`, and lines with a `$`. How lines look to
// such a sender is the printer's; jogs are in jogs.cpp.
#include <string.h>

#include "machine.h"
#include "version.h"

namespace machine {

void Machine::askStatus(bool is_in_line) {
  // Maslow clients never send it, so at the beginning of a line it says who is there.
  if (!base_.out.speaksGrbl() && is_in_line) return;
  if (!base_.out.speaksGrbl()) is_new_to_grbl_ = true;
  is_sure_ = base_.out.speaksGrbl();
  base_.out.speak(Dialect::kGrbl);
  is_status_due_ = true;
}

/// Whether a line shows that the only `?` so far was noise: GroundControl and WebControl put a
/// space behind each line, and senders of Grbl go on asking.
bool Machine::isOfMaslow(const char* line) const {
  const size_t length = strlen(line);
  return base_.out.speaksGrbl() && !is_sure_ && length != 0 && line[length - 1] == ' ';
}

/// A client of Maslow's is there: it knows nothing of check mode.
void Machine::speakMaslow() {
  base_.out.speak(Dialect::kMaslow);
  if (base_.course.is(State::kChecking)) base_.course.take(Event::kCheck);
}

FlashText Machine::stateForGrbl() {
  // No program begins from a place that nobody knows, and its place in the status is none.
  if (isHalted() || !place_.isKnown()) return FLASH("Alarm");
  if (base_.course.isWaiting()) return base_.axes.isAtRest() ? FLASH("Hold:0") : FLASH("Hold:1");
  if (base_.course.is(State::kChecking)) return FLASH("Check");
  if (base_.course.is(State::kJogging) && isMoving()) return FLASH("Jog");
  return isMoving() || is_executing_ ? FLASH("Run") : FLASH("Idle");
}

/// Three coordinates [mm], in the units of reports.
void Machine::sayPlace(const Place& place) {
  const bool inches = base_.values.at(kReportInches) != 0;
  const float unit = inches ? 1 / gcode::kMmPerInch : 1;
  const uint8_t decimals = inches ? 4 : 3;
  base_.out.fixed(place.x * unit, decimals) << ',';
  base_.out.fixed(place.y * unit, decimals) << ',';
  base_.out.fixed(place.z * unit, decimals);
}

void Machine::answerStatus() {
  if (!is_status_due_) return;
  is_status_due_ = false;
  const bool inches = base_.values.at(kReportInches) != 0;
  const float a_minute = 60 * float(ticks_per_second_) * overrides_.shareOfPlan();
  const float speed = base_.axes.isPathAtRest() ? 0 : base_.planner.speed() * a_minute;
  base_.out << '<' << stateForGrbl() << FLASH("|MPos:");
  sayPlace(placeNow());
  base_.out << FLASH("|FS:");
  base_.out.fixed(inches ? speed / gcode::kMmPerInch : speed, inches ? 1 : 0) << ',';
  base_.out.fixed(spindle_.isOn() ? base_.cutter.s() : 0, 0) << FLASH("|WCO:");
  sayPlace({coordinates_.begin(0), coordinates_.begin(1), coordinates_.begin(2)});
  base_.out << FLASH("|Ov:") << int32_t(overrides_.feed()) << ',' << int32_t(overrides_.rapid())
            << ',' << int32_t(overrides_.spindle());
  if (base_.aux.probeTouches()) base_.out << FLASH("|Pn:P");
  base_.out.line(FLASH(">"));
  if (!is_new_to_grbl_) return;
  is_new_to_grbl_ = false;
  // CNCjs asks for numbers before its first question mark, and never again. From the dump for
  // Maslow clients it would learn that places are in inches ($13).
  settings_lines_.sayGrblNumbers();
  if (!place_.isKnown()) base_.out.line(place_.whatIsLost());
}

void Machine::resetAsGrbl() {
  stopNow();
  resetOverrides();
  resetModes();
  greeting_.sayWelcome();
}

/// The modes with which a sender of Grbl begins.
void Machine::resetModes() {
  const float feed = base_.modal.feed;
  base_.modal = gcode::Modal();
  base_.modal.feed = feed;
}

bool Machine::runGrbl(const char* line) {
  const char* const text = line + 1;
  if (strncmp_P(text, PSTR("J="), 2) == 0) return jog(text + 2);
  if (text[0] == 'N' && text[1] != '\0')
    return base_.answers.refuse(FLASH("no lines are kept for the start"));
  if (strncmp_P(text, PSTR("RST="), 4) == 0) return drain() && runReset(text + 4);
  if (strchr(text, '=') != nullptr) return drain() && settings_lines_.setForGrbl(text);
  if (text[0] != '\0' && text[1] != '\0') return base_.answers.refuseStatement();
  switch (*text) {
    case '\0':
      base_.out.line(FLASH("[HLP:$$ $# $G $I $N $x=val $J=line $C $X $H $RST= ~ ! ? ctrl-x]"));
      return true;
    case '$':
      settings_lines_.dumpForGrbl();
      return true;
    case '#':
      showCoordinates();
      return true;
    case 'G':
      showModes();
      return true;
    case 'I':
      base_.out.line(FLASH("[VER:1.1h.20261125:Plumb " PLUMB_VERSION "]"));
      // V: a spindle of more than one speed. Then moves that wait, and characters.
      base_.out.line(FLASH("[OPT:V,16,128]"));
      return true;
    case 'N':
      base_.out.line(FLASH("$N0="));
      base_.out.line(FLASH("$N1="));
      return true;
    case 'X':
      return unlock();
    case 'C':
      return toggleCheck();
    case 'H':
      return base_.answers.refuse(
          FLASH("no switches to search for. Where the place is lost, set the "
                "chains (B06 or B08) and z (G10 Z0)"),
          grbl::kNoHoming);
    default:
      return base_.answers.refuseStatement();
  }
}

void Machine::showCoordinates() {
  const uint8_t kG28 = kKeptSystems;
  for (uint8_t place = 0; place < kKeptSystems + 2; ++place) {
    const int32_t code = place < kG28 ? 54 + place : 28 + 2 * (place - kG28);
    base_.out << FLASH("[G") << code << ':';
    sayPlace(coordinates_.kept(place));
    base_.out.line(FLASH("]"));
  }
  const gcode::WorkOffsets& offsets = coordinates_.offsets();
  base_.out << FLASH("[G92:");
  sayPlace({offsets.shiftNow(0), offsets.shiftNow(1), offsets.shiftNow(2)});
  base_.out.line(FLASH("]"));
  const bool inches = base_.values.at(kReportInches) != 0;
  base_.out << FLASH("[TLO:");
  base_.out.fixed(inches ? offsets.toolLength() / gcode::kMmPerInch : offsets.toolLength(), 3);
  base_.out.line(FLASH("]"));
  sayProbed();
}

void Machine::sayProbed() {
  base_.out << FLASH("[PRB:");
  sayPlace(single_axis_.probed());
  base_.out.line(single_axis_.hasProbed() ? FLASH(":1]") : FLASH(":0]"));
}

void Machine::showModes() {
  base_.out << FLASH("[GC:G") << int32_t(base_.modal.motion);
  base_.out << FLASH(" G") << int32_t(54 + base_.modal.system) << FLASH(" G")
            << int32_t(base_.modal.plane);
  base_.out << (base_.modal.inches ? FLASH(" G20") : FLASH(" G21"));
  base_.out << (base_.modal.relative ? FLASH(" G91") : FLASH(" G90"));
  base_.out << (base_.modal.inverse_time ? FLASH(" G93") : FLASH(" G94"));
  base_.out << (spindle_.isOn() ? FLASH(" M3 M9 T") : FLASH(" M5 M9 T"))
            << int32_t(base_.modal.tool);
  base_.out << FLASH(" F");
  base_.out.fixed(base_.modal.fromMm(base_.modal.feed), base_.modal.inches ? 1 : 0) << FLASH(" S");
  base_.out.fixed(base_.cutter.s(), 0).line(FLASH("]"));
}

bool Machine::unlock() {
  base_.out.line(FLASH("[MSG:Caution: Unlocked]"));
  base_.out.plain(FLASH("ok"));
  base_.answers.setAnswered(true);
  const bool is_lost = base_.keeper.hasLost() || !place_.isKnown();
  // The end of a stop says what was lost once all stands.
  if (is_lost && !(isHalted() && base_.keeper.hasLost())) base_.out.line(place_.whatIsLost());
  if (isHalted()) {
    base_.course.take(Event::kStop);
    base_.cutter.off();
  }
  return true;
}

bool Machine::toggleCheck() {
  base_.course.take(Event::kCheck);
  const bool checks = base_.course.is(State::kChecking);
  base_.out.line(checks ? FLASH("[MSG:Enabled]") : FLASH("[MSG:Disabled]"));
  if (!checks) resetModes();
  return true;
}

/// Looks for mistakes and for codes that this machine does not know; nothing is done.
bool Machine::checkCode(const char* text) {
  base_.answers.serve(true);
  const gcode::Mistake mistake = gcode::findMistake(text);
  bool is_right = mistake.fault == gcode::Fault::kNone || base_.answers.refuseMistake(mistake);
  gcode::Piece piece;
  for (gcode::Pieces pieces(text); is_right && pieces.next(piece);)
    if (piece.letter == 'G' && !base_.modal.take(piece.tenths) && !knows(piece))
      is_right = base_.answers.refuseCode(piece);
  base_.answers.serve(false);
  return is_right;
}

}  // namespace machine
