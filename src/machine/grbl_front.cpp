// What a sender of Grbl asks for: the status at each `?`, lines with a `$`, and jogs. How lines
// look to such a sender is the printer's.
#include "grbl_front.h"

#include <string.h>

#include "version.h"

namespace machine {

using gcode::Words;

void GrblFront::askStatus(bool is_in_line) {
  // Maslow clients never send it, so at the beginning of a line it says who is there.
  if (!base_.out.speaksGrbl() && is_in_line) return;
  if (!base_.out.speaksGrbl()) is_new_ = true;
  is_sure_ = base_.out.speaksGrbl();
  base_.out.speak(Dialect::kGrbl);
  is_status_due_ = true;
}

/// Whether a line shows that the only `?` so far was noise: GroundControl and WebControl put a
/// space behind each line, and senders of Grbl go on asking.
bool GrblFront::isOfMaslow(const char* line) const {
  const size_t length = strlen(line);
  return base_.out.speaksGrbl() && !is_sure_ && length != 0 && line[length - 1] == ' ';
}

/// Some senders of Grbl begin with these, and no client of Maslow's does.
bool GrblFront::isGreetedBy(const char* line) {
  if ((line[1] != 'I' && line[1] != 'G') || line[2] != '\0') return false;
  is_sure_ = true;
  base_.out.speak(Dialect::kGrbl);
  return true;
}

/// A client of Maslow's is there: it knows nothing of check mode.
void GrblFront::speakMaslow() {
  base_.out.speak(Dialect::kMaslow);
  if (base_.course.is(State::kChecking)) base_.course.take(Event::kCheck);
}

FlashText GrblFront::stateNow(bool is_executing) {
  // No program begins from a place that nobody knows, and its place in the status is none.
  if (base_.course.isHalted() || !place_.isKnown()) return FLASH("Alarm");
  if (base_.course.isWaiting()) return base_.axes.isAtRest() ? FLASH("Hold:0") : FLASH("Hold:1");
  if (base_.course.is(State::kChecking)) return FLASH("Check");
  if (base_.course.is(State::kJogging) && base_.waiting.isMoving()) return FLASH("Jog");
  return base_.waiting.isMoving() || is_executing ? FLASH("Run") : FLASH("Idle");
}

void GrblFront::answerStatus(const Place& place, bool is_executing) {
  if (!is_status_due_) return;
  is_status_due_ = false;
  const bool inches = base_.values.at(kReportInches) != 0;
  const float a_minute = 60 * 1 / base_.axes.secondsPerTick() * overrides_.now().shareOfPlan();
  const float speed = base_.axes.isPathAtRest() ? 0 : base_.planner.speed() * a_minute;
  base_.out << '<' << stateNow(is_executing) << FLASH("|MPos:");
  reports_.sayPlace(place);
  base_.out << FLASH("|FS:");
  base_.out.fixed(inches ? speed / gcode::kMmPerInch : speed, inches ? 1 : 0) << ',';
  base_.out.fixed(spindle_.isOn() ? base_.cutter.s() : 0, 0) << FLASH("|WCO:");
  reports_.sayPlace({coordinates_.begin(0), coordinates_.begin(1), coordinates_.begin(2)});
  base_.out << FLASH("|Ov:") << int32_t(overrides_.now().feed()) << ','
            << int32_t(overrides_.now().rapid()) << ',' << int32_t(overrides_.now().spindle());
  if (base_.aux.probeTouches()) base_.out << FLASH("|Pn:P");
  base_.out.line(FLASH(">"));
  if (!is_new_) return;
  is_new_ = false;
  // CNCjs asks for numbers before its first question mark, and never again. From the dump for
  // Maslow clients it would learn that places are in inches ($13).
  settings_lines_.sayGrblNumbers();
  if (!place_.isKnown()) base_.out.line(place_.whatIsLost());
}

void GrblFront::reset() {
  stops_.stop();
  overrides_.reset();
  resetModes();
  greeting_.sayWelcome();
}

/// The modes with which a sender of Grbl begins.
void GrblFront::resetModes() {
  const float feed = base_.modal.feed;
  base_.modal = gcode::Modal();
  base_.modal.feed = feed;
}

bool GrblFront::run(const char* line) {
  const char* const text = line + 1;
  if (strncmp_P(text, PSTR("J="), 2) == 0) return jog(text + 2);
  if (text[0] == 'N' && text[1] != '\0')
    return base_.answers.refuse(FLASH("no lines are kept for the start"));
  if (strncmp_P(text, PSTR("RST="), 4) == 0)
    return base_.waiting.drain() && settings_lines_.reset(text + 4);
  if (strchr(text, '=') != nullptr)
    return base_.waiting.drain() && settings_lines_.setForGrbl(text);
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

void GrblFront::showCoordinates() {
  const uint8_t kG28 = kKeptSystems;
  for (uint8_t place = 0; place < kKeptSystems + 2; ++place) {
    const int32_t code = place < kG28 ? 54 + place : 28 + 2 * (place - kG28);
    base_.out << FLASH("[G") << code << ':';
    reports_.sayPlace(coordinates_.kept(place));
    base_.out.line(FLASH("]"));
  }
  const gcode::WorkOffsets& offsets = coordinates_.offsets();
  base_.out << FLASH("[G92:");
  reports_.sayPlace({offsets.shiftNow(0), offsets.shiftNow(1), offsets.shiftNow(2)});
  base_.out.line(FLASH("]"));
  const bool inches = base_.values.at(kReportInches) != 0;
  base_.out << FLASH("[TLO:");
  base_.out.fixed(inches ? offsets.toolLength() / gcode::kMmPerInch : offsets.toolLength(), 3);
  base_.out.line(FLASH("]"));
  single_axis_.sayProbed();
}

void GrblFront::showModes() {
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

bool GrblFront::unlock() {
  base_.out.line(FLASH("[MSG:Caution: Unlocked]"));
  base_.out.plain(FLASH("ok"));
  base_.answers.setAnswered(true);
  const bool is_lost = base_.keeper.hasLost() || !place_.isKnown();
  // The end of a stop says what was lost once all stands.
  if (is_lost && !(base_.course.isHalted() && base_.keeper.hasLost()))
    base_.out.line(place_.whatIsLost());
  if (base_.course.isHalted()) {
    base_.course.take(Event::kStop);
    base_.cutter.off();
  }
  return true;
}

bool GrblFront::toggleCheck() {
  base_.course.take(Event::kCheck);
  const bool checks = base_.course.is(State::kChecking);
  base_.out.line(checks ? FLASH("[MSG:Enabled]") : FLASH("[MSG:Disabled]"));
  if (!checks) resetModes();
  return true;
}

bool GrblFront::jog(const char* text) {
  base_.course.take(Event::kJog);
  const gcode::Modal program = base_.modal;
  // Nothing of a program depends on a jog, so no refusal halts the machine.
  base_.answers.serve(true);
  const bool done = queueJog(text);
  base_.answers.serve(false);
  base_.modal = program;
  if (base_.answers.isAnswered()) return done;
  // At once, for a sender waits with its next jog; and also where 0x85 ended the wait for room.
  base_.out.plain(FLASH("ok"));
  base_.answers.setAnswered(true);
  return done;
}

bool GrblFront::queueJog(const char* text) {
  const gcode::Mistake mistake = gcode::findMistake(text);
  if (mistake.fault != gcode::Fault::kNone) return base_.answers.refuseMistake(mistake);
  new_values_.refreshBeforeLine();
  Words words;
  base_.modal.beginLine();
  base_.modal.motion = 0;
  if (!readJog(text, words)) return false;
  if (!words.has('F')) return base_.answers.refuse(FLASH("a jog needs F"), grbl::kNoFeed);
  if (words.has('Z') && !z_.hasMotor())
    return base_.answers.refuse(FLASH("z has no motor ($16)"), grbl::kBadJog);
  // A jog begins where the sled is, even at the sheet's edge.
  base_.program.countFromAim();
  const float kLeastFeed = 1;  // [mm/min]
  const float most = moves_.feedOf(0), asked = base_.modal.toMm(words.value('F'));
  const float feed = !(asked > kLeastFeed) ? kLeastFeed : asked < most ? asked : most;
  return moves_.moveStraight(moves_.targetOf(words), goesAcross(words), feed);
}

/// Takes a jog's codes into the modes, and its words; false, with a refusal, where it has others.
bool GrblFront::readJog(const char* text, Words& words) {
  gcode::Piece piece;
  for (gcode::Pieces pieces(text); pieces.next(piece);) {
    const bool is_mode = piece.tenths == 200 || piece.tenths == 210 || piece.tenths == 530 ||
                         piece.tenths == 900 || piece.tenths == 910;
    if (piece.letter != gcode::kNoLetter && !(piece.letter == 'G' && is_mode))
      return base_.answers.refuse(FLASH("a jog takes G20, G21, G53, G90 and G91 only"),
                                  grbl::kBadJog);
    if (piece.letter == 'G') base_.modal.take(piece.tenths);
    for (const char* letter = "XYZF"; *letter != '\0'; ++letter)
      if (piece.words.has(*letter)) words.add(*letter, piece.words.value(*letter));
  }
  return words.hasPlace() || base_.answers.refuse(FLASH("a jog needs X, Y or Z"), grbl::kBadJog);
}

void GrblFront::endJog() {
  // A sender may have sent more of them than there is room for.
  if (base_.course.take(Event::kEndJog)) dropped_jogs_ = base_.input.lines();
}

bool GrblFront::isDroppedJog(const char* line) {
  if (dropped_jogs_ == 0) return false;
  --dropped_jogs_;
  return strncmp_P(line, PSTR("$J="), 3) == 0;
}

}  // namespace machine
