// Requests of a Grbl sender: the status at each `?`, lines with a `$`, and jogs. How lines look is
// up to the printer.
#include "grbl_front.h"

#include <string.h>

#include "version.h"

namespace machine {

using gcode::Words;

void GrblFront::askStatus(bool is_in_line) {
  // Maslow clients never send it, so at the beginning of a line it tells a Grbl sender.
  if (!parts_.out.speaksGrbl() && is_in_line) return;
  if (!parts_.out.speaksGrbl()) is_new_ = true;
  is_sure_ = parts_.out.speaksGrbl();
  parts_.out.speak(Dialect::kGrbl);
  is_status_due_ = true;
}

/// Whether a line shows that the only `?` so far was noise: GroundControl and WebControl put a
/// space behind each line, and Grbl senders go on asking.
bool GrblFront::isOfMaslow(const char* line) const {
  const size_t length = strlen(line);
  return parts_.out.speaksGrbl() && !is_sure_ && length != 0 && line[length - 1] == ' ';
}

/// Some Grbl senders begin with these, and no Maslow client does.
bool GrblFront::isGreetedBy(const char* line) {
  if (line[1] == '\0' || line[2] != '\0' || strchr("IGX", line[1]) == nullptr) return false;
  is_sure_ = true;
  parts_.out.speak(Dialect::kGrbl);
  return true;
}

/// A Maslow client is connected; it does not know check mode.
void GrblFront::speakMaslow() {
  parts_.out.speak(Dialect::kMaslow);
  if (parts_.course.is(State::kChecking)) parts_.course.take(Event::kCheck);
}

FlashText GrblFront::stateNow(bool is_executing) {
  // No program can begin from an unknown place, and the status has none to show.
  if (parts_.course.isHalted() || !parts_.place.isKnown()) return FLASH("Alarm");
  if (parts_.course.isWaiting()) return parts_.axes.isAtRest() ? FLASH("Hold:0") : FLASH("Hold:1");
  if (parts_.course.is(State::kChecking)) return FLASH("Check");
  if (parts_.course.is(State::kJogging) && parts_.waiting.isMoving()) return FLASH("Jog");
  return parts_.waiting.isMoving() || is_executing ? FLASH("Run") : FLASH("Idle");
}

void GrblFront::answerStatus(bool is_executing) {
  if (!is_status_due_) return;
  is_status_due_ = false;
  const bool inches = parts_.values.at(kReportInches) != 0;
  const float a_minute =
      60 * 1 / parts_.axes.secondsPerTick() * parts_.overrides.now().shareOfPlan();
  const float speed = parts_.axes.isPathAtRest() ? 0 : parts_.planner.speed() * a_minute;
  parts_.out << '<' << stateNow(is_executing) << FLASH("|MPos:");
  parts_.reports.sayPlace(
      parts_.place.now(parts_.waiting.isMoving() || parts_.waiting.isStopping()));
  parts_.out << FLASH("|FS:");
  parts_.out.fixed(inches ? speed / gcode::kMmPerInch : speed, inches ? 1 : 0) << ',';
  parts_.out.fixed(parts_.cutter.isSpindleOn() ? parts_.cutter.s() : 0, 0) << FLASH("|WCO:");
  parts_.reports.sayPlace(
      {parts_.coordinates.begin(0), parts_.coordinates.begin(1), parts_.coordinates.begin(2)});
  parts_.out << FLASH("|Ov:") << int32_t(parts_.overrides.now().feed()) << ','
             << int32_t(parts_.overrides.now().rapid()) << ','
             << int32_t(parts_.overrides.now().spindle());
  if (parts_.aux.probeTouches()) parts_.out << FLASH("|Pn:P");
  parts_.out.line(FLASH(">"));
  if (!is_new_) return;
  is_new_ = false;
  // CNCjs asks for numbers before its first question mark, and never again. From the dump for
  // Maslow clients it would learn that places are in inches ($13).
  parts_.settings_lines.sayGrblNumbers();
  if (!parts_.place.isKnown()) parts_.out.line(parts_.place.whatIsLost());
}

void GrblFront::reset() {
  stops_.stop();
  parts_.overrides.reset();
  resetModes();
  parts_.greeting.sayWelcome();
}

/// The modes with which a Grbl sender begins.
void GrblFront::resetModes() {
  const float feed = parts_.modal.feed;
  parts_.modal = gcode::Modal();
  parts_.modal.feed = feed;
}

bool GrblFront::run(const char* line) {
  const char* const text = line + 1;
  if (strncmp_P(text, PSTR("J="), 2) == 0) return jog(text + 2);
  if (text[0] == 'N' && text[1] != '\0')
    return parts_.answers.refuse(FLASH("no lines are kept for the start"));
  if (strncmp_P(text, PSTR("RST="), 4) == 0)
    return parts_.waiting.drain() && parts_.settings_lines.reset(text + 4);
  if (strchr(text, '=') != nullptr)
    return parts_.waiting.drain() && parts_.settings_lines.setForGrbl(text);
  if (text[0] != '\0' && text[1] != '\0') return parts_.answers.refuseStatement();
  switch (*text) {
    case '\0':
      parts_.out.line(FLASH("[HLP:$$ $# $G $I $N $x=val $J=line $C $X $H $RST= ~ ! ? ctrl-x]"));
      return true;
    case '$':
      parts_.settings_lines.dumpForGrbl();
      return true;
    case '#':
      showCoordinates();
      return true;
    case 'G':
      showModes();
      return true;
    case 'I':
      parts_.out.line(FLASH("[VER:1.1h.20261125:Plumb " PLUMB_VERSION "]"));
      // V: a spindle with variable speed. Then the waiting moves and characters.
      parts_.out.line(FLASH("[OPT:V,16,128]"));
      return true;
    case 'N':
      parts_.out.line(FLASH("$N0="));
      parts_.out.line(FLASH("$N1="));
      return true;
    case 'X':
      return unlock();
    case 'C':
      return toggleCheck();
    case 'H':
      return parts_.answers.refuse(
          FLASH("no switches to search for. Where the place is lost, set the "
                "chains (B06 or B08) and z (G10 Z0)"),
          grbl::kNoHoming);
    default:
      return parts_.answers.refuseStatement();
  }
}

void GrblFront::showCoordinates() {
  const uint8_t kG28 = kKeptSystems;
  for (uint8_t place = 0; place < kKeptSystems + 2; ++place) {
    const int32_t code = place < kG28 ? 54 + place : 28 + 2 * (place - kG28);
    parts_.out << FLASH("[G") << code << ':';
    parts_.reports.sayPlace(parts_.coordinates.kept(place));
    parts_.out.line(FLASH("]"));
  }
  const gcode::WorkOffsets& offsets = parts_.coordinates.offsets();
  parts_.out << FLASH("[G92:");
  parts_.reports.sayPlace({offsets.shiftNow(0), offsets.shiftNow(1), offsets.shiftNow(2)});
  parts_.out.line(FLASH("]"));
  const bool inches = parts_.values.at(kReportInches) != 0;
  parts_.out << FLASH("[TLO:");
  parts_.out.fixed(inches ? offsets.toolLength() / gcode::kMmPerInch : offsets.toolLength(), 3);
  parts_.out.line(FLASH("]"));
  parts_.single_axis.sayProbed();
}

void GrblFront::showModes() {
  parts_.out << FLASH("[GC:G") << int32_t(parts_.modal.motion);
  parts_.out << FLASH(" G") << int32_t(54 + parts_.modal.system) << FLASH(" G")
             << int32_t(parts_.modal.plane);
  parts_.out << (parts_.modal.inches ? FLASH(" G20") : FLASH(" G21"));
  parts_.out << (parts_.modal.relative ? FLASH(" G91") : FLASH(" G90"));
  parts_.out << (parts_.modal.inverse_time ? FLASH(" G93") : FLASH(" G94"));
  parts_.out << (parts_.cutter.isSpindleOn() ? FLASH(" M3 M9 T") : FLASH(" M5 M9 T"))
             << int32_t(parts_.modal.tool);
  parts_.out << FLASH(" F");
  parts_.out.fixed(parts_.modal.fromMm(parts_.modal.feed), parts_.modal.inches ? 1 : 0)
      << FLASH(" S");
  parts_.out.fixed(parts_.cutter.s(), 0).line(FLASH("]"));
}

bool GrblFront::unlock() {
  parts_.out.line(FLASH("[MSG:Caution: Unlocked]"));
  parts_.out.plain(FLASH("ok"));
  parts_.answers.setAnswered(true);
  const bool is_lost = parts_.keeper.hasLost() || !parts_.place.isKnown();
  // At the end of a stop, once everything stands, a message says what was lost.
  if (is_lost && !(parts_.course.isHalted() && parts_.keeper.hasLost()))
    parts_.out.line(parts_.place.whatIsLost());
  if (parts_.course.isHalted()) {
    parts_.course.take(Event::kStop);
    parts_.cutter.off();
  }
  return true;
}

bool GrblFront::toggleCheck() {
  parts_.course.take(Event::kCheck);
  const bool checks = parts_.course.is(State::kChecking);
  parts_.out.line(checks ? FLASH("[MSG:Enabled]") : FLASH("[MSG:Disabled]"));
  if (!checks) resetModes();
  return true;
}

bool GrblFront::jog(const char* text) {
  parts_.course.take(Event::kJog);
  const gcode::Modal program = parts_.modal;
  // No program depends on a jog, so a refused one does not halt the machine.
  parts_.answers.serve(true);
  const bool done = queueJog(text);
  parts_.answers.serve(false);
  parts_.modal = program;
  if (parts_.answers.isAnswered()) return done;
  // At once, as the sender waits for it before the next jog; also if 0x85 ended the wait for room.
  parts_.out.plain(FLASH("ok"));
  parts_.answers.setAnswered(true);
  return done;
}

bool GrblFront::queueJog(const char* text) {
  const gcode::Mistake mistake = gcode::findMistake(text);
  if (mistake.fault != gcode::Fault::kNone) return parts_.answers.refuseMistake(mistake);
  parts_.new_values.refreshBeforeLine();
  Words words;
  parts_.modal.beginLine();
  parts_.modal.motion = 0;
  if (!readJog(text, words)) return false;
  if (!words.has('F')) return parts_.answers.refuse(FLASH("a jog needs F"), grbl::kNoFeed);
  if (words.has('Z') && !parts_.z.hasMotor())
    return parts_.answers.refuse(FLASH("z has no motor ($16)"), grbl::kBadJog);
  // A jog begins where the sled is, even at the sheet's edge.
  parts_.program.countFromAim();
  const float kLeastFeed = 1;  // [mm/min]
  const float most = parts_.moves.feedOf(0), asked = parts_.modal.toMm(words.value('F'));
  const float feed = !(asked > kLeastFeed) ? kLeastFeed : asked < most ? asked : most;
  return parts_.moves.moveStraight(parts_.moves.targetOf(words), goesAcross(words), feed);
}

/// Takes a jog's modes and words; false, with a refusal, if it has other codes.
bool GrblFront::readJog(const char* text, Words& words) {
  gcode::Piece piece;
  for (gcode::Pieces pieces(text); pieces.next(piece);) {
    const bool is_mode = piece.tenths == 200 || piece.tenths == 210 || piece.tenths == 530 ||
                         piece.tenths == 900 || piece.tenths == 910;
    if (piece.letter != gcode::kNoLetter && !(piece.letter == 'G' && is_mode))
      return parts_.answers.refuse(FLASH("a jog takes G20, G21, G53, G90 and G91 only"),
                                   grbl::kBadJog);
    if (piece.letter == 'G') parts_.modal.take(piece.tenths);
    for (const char* letter = "XYZF"; *letter != '\0'; ++letter)
      if (piece.words.has(*letter)) words.add(*letter, piece.words.value(*letter));
  }
  return words.hasPlace() || parts_.answers.refuse(FLASH("a jog needs X, Y or Z"), grbl::kBadJog);
}

void GrblFront::endJog() {
  // A sender may have sent more of them than there is room for.
  if (parts_.course.take(Event::kEndJog)) dropped_jogs_ = parts_.input.lines();
}

bool GrblFront::isDroppedJog(const char* line) {
  if (dropped_jogs_ == 0) return false;
  --dropped_jogs_;
  return strncmp_P(line, PSTR("$J="), 3) == 0;
}

}  // namespace machine
