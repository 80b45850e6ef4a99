// What a sender of Grbl asks for: the status at each `?`, and lines with a `$`. How lines look to
// such a sender is the printer's; jogs are in jogs.cpp.
#include <string.h>

#include "machine.h"
#include "version.h"

namespace machine {

void Machine::askStatus(bool is_in_line) {
  // Maslow clients never send it, so at the beginning of a line it says who is there.
  if (!out_.speaksGrbl() && is_in_line) return;
  if (!out_.speaksGrbl()) is_new_to_grbl_ = true;
  is_sure_ = out_.speaksGrbl();
  out_.speak(Dialect::kGrbl);
  is_status_due_ = true;
}

/// Whether a line shows that the only `?` so far was noise: GroundControl and WebControl put a
/// space behind each line, and senders of Grbl go on asking.
bool Machine::isOfMaslow(const char* line) const {
  const size_t length = strlen(line);
  return out_.speaksGrbl() && !is_sure_ && length != 0 && line[length - 1] == ' ';
}

/// A client of Maslow's is there: it knows nothing of check mode.
void Machine::speakMaslow() {
  out_.speak(Dialect::kMaslow);
  if (course_.is(State::kChecking)) course_.take(Event::kCheck);
}

FlashText Machine::stateForGrbl() {
  // No program begins from a place that nobody knows, and its place in the status is none.
  if (isHalted() || !place_.isKnown()) return FLASH("Alarm");
  if (course_.isWaiting()) return axes_.isAtRest() ? FLASH("Hold:0") : FLASH("Hold:1");
  if (course_.is(State::kChecking)) return FLASH("Check");
  if (course_.is(State::kJogging) && isMoving()) return FLASH("Jog");
  return isMoving() || is_executing_ ? FLASH("Run") : FLASH("Idle");
}

/// Three coordinates [mm], in the units of reports.
void Machine::sayPlace(const Place& place) {
  const bool inches = values_.at(kReportInches) != 0;
  const float unit = inches ? 1 / gcode::kMmPerInch : 1;
  const uint8_t decimals = inches ? 4 : 3;
  out_.fixed(place.x * unit, decimals) << ',';
  out_.fixed(place.y * unit, decimals) << ',';
  out_.fixed(place.z * unit, decimals);
}

void Machine::answerStatus() {
  if (!is_status_due_) return;
  is_status_due_ = false;
  const bool inches = values_.at(kReportInches) != 0;
  const float a_minute = 60 * float(ticks_per_second_) * overrides_.shareOfPlan();
  const float speed = axes_.isPathAtRest() ? 0 : planner_.speed() * a_minute;
  out_ << '<' << stateForGrbl() << FLASH("|MPos:");
  sayPlace(placeNow());
  out_ << FLASH("|FS:");
  out_.fixed(inches ? speed / gcode::kMmPerInch : speed, inches ? 1 : 0) << ',';
  out_.fixed(spindle_.isOn() ? cutter_.s() : 0, 0) << FLASH("|WCO:");
  sayPlace({coordinates_.begin(0), coordinates_.begin(1), coordinates_.begin(2)});
  out_ << FLASH("|Ov:") << int32_t(overrides_.feed()) << ',' << int32_t(overrides_.rapid()) << ','
       << int32_t(overrides_.spindle());
  if (aux_.probeTouches()) out_ << FLASH("|Pn:P");
  out_.line(FLASH(">"));
  if (!is_new_to_grbl_) return;
  is_new_to_grbl_ = false;
  // CNCjs asks for numbers before its first question mark, and never again. From the dump for
  // Maslow clients it would learn that places are in inches ($13).
  settings_lines_.sayGrblNumbers();
  if (!place_.isKnown()) out_.line(place_.whatIsLost());
}

void Machine::resetAsGrbl() {
  stopNow();
  resetOverrides();
  resetModes();
  greeting_.sayWelcome();
}

/// The modes with which a sender of Grbl begins.
void Machine::resetModes() {
  const float feed = modal_.feed;
  modal_ = gcode::Modal();
  modal_.feed = feed;
}

bool Machine::runGrbl(const char* line) {
  const char* const text = line + 1;
  if (strncmp_P(text, PSTR("J="), 2) == 0) return jog(text + 2);
  if (text[0] == 'N' && text[1] != '\0')
    return answers_.refuse(FLASH("no lines are kept for the start"));
  if (strncmp_P(text, PSTR("RST="), 4) == 0) return drain() && runReset(text + 4);
  if (strchr(text, '=') != nullptr) return drain() && settings_lines_.setForGrbl(text);
  if (text[0] != '\0' && text[1] != '\0') return answers_.refuseStatement();
  switch (*text) {
    case '\0':
      out_.line(FLASH("[HLP:$$ $# $G $I $N $x=val $J=line $C $X $H $RST= ~ ! ? ctrl-x]"));
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
      out_.line(FLASH("[VER:1.1h.20261125:Plumb " PLUMB_VERSION "]"));
      // V: a spindle of more than one speed. Then moves that wait, and characters.
      out_.line(FLASH("[OPT:V,16,128]"));
      return true;
    case 'N':
      out_.line(FLASH("$N0="));
      out_.line(FLASH("$N1="));
      return true;
    case 'X':
      return unlock();
    case 'C':
      return toggleCheck();
    case 'H':
      return answers_.refuse(FLASH("no switches to search for. Where the place is lost, set the "
                                   "chains (B06 or B08) and z (G10 Z0)"),
                             grbl::kNoHoming);
    default:
      return answers_.refuseStatement();
  }
}

void Machine::showCoordinates() {
  const uint8_t kG28 = kKeptSystems;
  for (uint8_t place = 0; place < kKeptSystems + 2; ++place) {
    const int32_t code = place < kG28 ? 54 + place : 28 + 2 * (place - kG28);
    out_ << FLASH("[G") << code << ':';
    sayPlace(coordinates_.kept(place));
    out_.line(FLASH("]"));
  }
  const gcode::WorkOffsets& offsets = coordinates_.offsets();
  out_ << FLASH("[G92:");
  sayPlace({offsets.shiftNow(0), offsets.shiftNow(1), offsets.shiftNow(2)});
  out_.line(FLASH("]"));
  const bool inches = values_.at(kReportInches) != 0;
  out_ << FLASH("[TLO:");
  out_.fixed(inches ? offsets.toolLength() / gcode::kMmPerInch : offsets.toolLength(), 3);
  out_.line(FLASH("]"));
  sayProbed();
}

void Machine::sayProbed() {
  out_ << FLASH("[PRB:");
  sayPlace(single_axis_.probed());
  out_.line(single_axis_.hasProbed() ? FLASH(":1]") : FLASH(":0]"));
}

void Machine::showModes() {
  out_ << FLASH("[GC:G") << int32_t(modal_.motion);
  out_ << FLASH(" G") << int32_t(54 + modal_.system) << FLASH(" G") << int32_t(modal_.plane);
  out_ << (modal_.inches ? FLASH(" G20") : FLASH(" G21"));
  out_ << (modal_.relative ? FLASH(" G91") : FLASH(" G90"));
  out_ << (modal_.inverse_time ? FLASH(" G93") : FLASH(" G94"));
  out_ << (spindle_.isOn() ? FLASH(" M3 M9 T") : FLASH(" M5 M9 T")) << int32_t(modal_.tool);
  out_ << FLASH(" F");
  out_.fixed(modal_.fromMm(modal_.feed), modal_.inches ? 1 : 0) << FLASH(" S");
  out_.fixed(cutter_.s(), 0).line(FLASH("]"));
}

bool Machine::unlock() {
  out_.line(FLASH("[MSG:Caution: Unlocked]"));
  out_.plain(FLASH("ok"));
  answers_.setAnswered(true);
  const bool is_lost = keeper_.hasLost() || !place_.isKnown();
  // The end of a stop says what was lost once all stands.
  if (is_lost && !(isHalted() && keeper_.hasLost())) out_.line(place_.whatIsLost());
  if (isHalted()) {
    course_.take(Event::kStop);
    cutter_.off();
  }
  return true;
}

bool Machine::toggleCheck() {
  course_.take(Event::kCheck);
  const bool checks = course_.is(State::kChecking);
  out_.line(checks ? FLASH("[MSG:Enabled]") : FLASH("[MSG:Disabled]"));
  if (!checks) resetModes();
  return true;
}

/// Looks for mistakes and for codes that this machine does not know; nothing is done.
bool Machine::checkCode(const char* text) {
  answers_.serve(true);
  const gcode::Mistake mistake = gcode::findMistake(text);
  bool is_right = mistake.fault == gcode::Fault::kNone || answers_.refuseMistake(mistake);
  gcode::Piece piece;
  for (gcode::Pieces pieces(text); is_right && pieces.next(piece);)
    if (piece.letter == 'G' && !modal_.take(piece.tenths) && !knows(piece))
      is_right = answers_.refuseCode(piece);
  answers_.serve(false);
  return is_right;
}

}  // namespace machine
