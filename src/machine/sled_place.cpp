// Chain lengths, the sled's place, and the stored record of both.
#include "parts.h"

namespace machine {
namespace {

const float kMovedByHand = 0.5f;  // [mm] more than chains give when motors are switched off

FlashText textOf(settings::Doubt why) {
  using settings::Doubt;
  switch (why) {
    case Doubt::kMoving:
      return FLASH("Power was lost before the position was kept.");
    case Doubt::kScale:
      return FLASH("Encoders are scaled otherwise ($12, $13, $19, $20) than when it was kept.");
    case Doubt::kPlace:
      return FLASH("The kept place is not where the chains put the sled.");
    case Doubt::kSimulated:
      return FLASH("Motion was simulated, so the chains are elsewhere.");
    case Doubt::kStack:
      return FLASH("The firmware's stack had run into its data.");
    default:
      return FLASH("The encoders' counts were wrong before power was lost.");
  }
}

}  // namespace

Whereabouts SledPlace::whereabouts() const {
  if (!parts_.keeper.trustsChains()) return Whereabouts::kLost;
  return hangs_ ? Whereabouts::kFound : Whereabouts::kNowhere;
}

FoundPlace SledPlace::byChains(float left, float right) const {
  return parts_.geometry.forward(left, right, {sled_.x, sled_.y});
}

void SledPlace::say() const {
  parts_.out.line(FLASH("position loaded at:"));
  parts_.out.fixed(parts_.modal.fromMm(sled_.x), 2).end();
  parts_.out.fixed(parts_.modal.fromMm(sled_.y), 2).end();
}

void SledPlace::sayLengths() const {
  parts_.out.fixed(parts_.axes.length(kLeftAxis), 2) << FLASH(", ");
  parts_.out.fixed(parts_.axes.length(kRightAxis), 2);
}

bool SledPlace::isSaid(Search why) {
  switch (why) {
    case Search::kStart:
    case Search::kDeclared:
    case Search::kCentred:
    case Search::kStopped:
    case Search::kNewSettings:
      return true;
    default:
      return false;
  }
}

bool SledPlace::search(Search why) {
  const bool is_said = isSaid(why) && parts_.keeper.trustsChains();
  if (is_said) moved_by_ = 0;
  // A Grbl sender reads the place from the status.
  const bool is_shown = is_said && !parts_.out.speaksGrbl();
  if (is_shown) parts_.out.line(FLASH("[Forward Calculating Position]"));
  const FoundPlace found = byChains(parts_.axes.length(kLeftAxis), parts_.axes.length(kRightAxis));
  hangs_ = found.found;
  parts_.axes.standStill();
  sled_.x = hangs_ ? found.at.x : 0;
  sled_.y = hangs_ ? found.at.y : 0;
  standHere();
  if (is_said && !hangs_) sayNowhere();
  if (is_shown && hangs_) say();
  return hangs_;
}

void SledPlace::standHere() {
  sled_.z = parts_.axes.length(kZAxis);
  parts_.program.beginAt(sled_);
  parts_.planner.standAt(parts_.axes.setPoint());
}

void SledPlace::declareZ(float z) {
  parts_.axes.declare(kZAxis, z);
  parts_.program.endAtZ(z);
  parts_.planner.standAt(parts_.axes.setPoint());
  parts_.keeper.declareZ();
}

void SledPlace::sayNowhere() {
  parts_.out << FLASH("Message: Unable to find valid machine position for chain lengths ");
  sayLengths();
  parts_.out.line(
      FLASH(" . Please set the chains to a known length (Actions -> Set Chain Lengths)"));
}

void SledPlace::restore(const settings::Started& started) {
  using settings::Known;
  const settings::Position& kept = started.position;
  const bool is_kept = started.known != Known::kNothing;
  parts_.axes.setCounts(is_kept ? kept.left : 0, is_kept ? kept.right : 0, is_kept ? kept.z : 0);
  parts_.keeper.begin(started.known);
  switch (started.known) {
    case Known::kNothing:
      search(Search::kStart);
      return sayUnset(started.source == settings::Source::kDefaults);
    case Known::kMoving:
      return lose(settings::Doubt::kMoving);
    case Known::kDoubted:
      return lose(parts_.memory.doubted());
    case Known::kAtRest:
      break;
  }
  const bool is_found = search(Search::kStart);
  using settings::Agreement;
  const Agreement agreement = settings::compare(kept, parts_.memory.scale(), sled_.x, sled_.y);
  if (agreement == Agreement::kScaleChanged)
    lose(settings::Doubt::kScale);
  else if (is_found && agreement == Agreement::kPlaceDiffers)
    lose(settings::Doubt::kPlace);
}

void SledPlace::sayUnset(bool has_defaults) {
  if (has_defaults) parts_.out << FLASH("Settings are the defaults. ");
  parts_.out.line(
      FLASH("Chain lengths are not known yet: send your settings, then set the chains "
            "(Actions -> Set Chain Lengths, or B06 L R)."));
}

void SledPlace::lose(settings::Doubt why) {
  parts_.keeper.doubt(kLeftAxis, why);
  // If the chains contradict the place, z may still be right. Else any axis may have moved.
  if (why != settings::Doubt::kPlace) parts_.keeper.doubt(kZAxis, why);
  parts_.axes.standStill();
  // Else the next move of z would start from chains of no length.
  standHere();
  // WebControl looks for the first two words.
  parts_.out.alarm(grbl::kAlarmOfFault)
      << FLASH("Position Lost. ") << textOf(why) << FLASH(" Last known chain lengths: ");
  sayLengths();
  parts_.out.line(FLASH(" mm. Set them (B06 L R), or set the chains to their marks (B08)."));
}

void SledPlace::doubtCounts() {
  for (uint8_t i = 0; i < kAxisCount; ++i)
    if (parts_.axes.isDisproved(Axis(i))) parts_.keeper.doubt(Axis(i), settings::Doubt::kCounts);
}

FlashText SledPlace::whatIsLost() const {
  switch (whereabouts()) {
    case Whereabouts::kLost:
      return FLASH("Position Lost: set the chain lengths first (B06 or B08)");
    case Whereabouts::kNowhere:
      return FLASH("the chains put the sled nowhere: set their lengths first (B06 or B08)");
    default:
      return FLASH("z is not known: set it first (G10 Z0 or G38.2)");
  }
}

void SledPlace::followPulledChains() {
  if (farthestOff() <= kMovedByHand) return;
  const bool begins = moved_by_ == 0;
  if (begins) left_at_ = parts_.program.aim();
  search(Search::kPulled);
  if (!isKnown()) return;
  if (begins) parts_.out.line(FLASH("The sled moves while its motors are off."));
  const float x = sled_.x - left_at_.x, y = sled_.y - left_at_.y, z = sled_.z - left_at_.z;
  moved_by_ = float(sqrt(x * x + y * y + z * z));
}

float SledPlace::farthestOff() const {
  float farthest = 0;
  for (uint8_t i = 0; i < kAxisCount; ++i) {
    const float off = float(fabs(parts_.axes.error(Axis(i))));
    if (off > farthest) farthest = off;
  }
  return farthest;
}

void SledPlace::keepWhenAtRest(uint32_t now_ms) {
  // A motor may run on, a chain may be pulled by hand, a heavy sled may sink: what is reported, and
  // where the next move begins, is where the sled is.
  if (parts_.keeper.isReleased()) followPulledChains();
  if (!parts_.keeper.isDue(now_ms)) return;
  settings::Position position;
  position.left = parts_.axes.counts(kLeftAxis);
  position.right = parts_.axes.counts(kRightAxis);
  position.z = parts_.axes.counts(kZAxis);
  // The record's place follows from the measured chains, not from the command: the next start
  // compares it with the chains.
  const FoundPlace found = byChains(parts_.axes.length(kLeftAxis), parts_.axes.length(kRightAxis));
  position.x = found.at.x;
  position.y = found.at.y;
  position.has_place = found.found;
  parts_.keeper.keep(position);
}

Place SledPlace::now(bool is_moving) {
  sled_.z = parts_.axes.length(kZAxis);
  if (!is_moving || !isKnown()) {
    sled_.x = parts_.program.aim().x;
    sled_.y = parts_.program.aim().y;
    return sled_;
  }
  const SetPoint point = parts_.axes.setPoint();
  // A search that begins at its last result may end a digit next to it.
  if (point.left == shown_left_ && point.right == shown_right_) return sled_;
  const FoundPlace found =
      byChains(motion::toMm<float>(point.left), motion::toMm<float>(point.right));
  if (found.found) {
    shown_left_ = point.left;
    shown_right_ = point.right;
    sled_.x = found.at.x;
    sled_.y = found.at.y;
  }
  return sled_;
}

}  // namespace machine
