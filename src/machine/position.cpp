// Where the sled is: found from the chains, kept over a power cut, said when it is not known.
#include "machine.h"

namespace machine {
namespace {

const float kMovedByHand = 0.5f;  // [mm] more than chains give way when motors are switched off
const uint32_t kRecordMs = 1000;  // a record is written in 0.3 s

}  // namespace

void Machine::sayPlace(float x, float y) {
  out_.line(FLASH("position loaded at:"));
  out_.fixed(inUnits(x), 2).end();
  out_.fixed(inUnits(y), 2).end();
}

void Machine::sayLengths() {
  out_.fixed(axes_.length(kLeftAxis), 2) << FLASH(", ");
  out_.fixed(axes_.length(kRightAxis), 2);
}

bool Machine::searchPlace() {
  const motion::Point<float> guess = {place_.x, place_.y};
  const FoundPlace found =
      geometry_.forward(axes_.length(kLeftAxis), axes_.length(kRightAxis), guess);
  axes_.standStill();
  is_place_known_ = found.found && keeper_.trustsChains();
  place_.x = found.found ? found.at.x : 0;
  place_.y = found.found ? found.at.y : 0;
  standHere();
  return found.found;
}

void Machine::standHere() {
  place_.z = axes_.length(kZAxis);
  aim_ = place_;
  counted_ = {aim_.x, aim_.y};
  mover_.standAt(axes_.setPoint());
}

bool Machine::findPlace() {
  out_.line(FLASH("[Forward Calculating Position]"));
  if (searchPlace()) {
    sayPlace(place_.x, place_.y);
    return true;
  }
  out_ << FLASH("Message: Unable to find valid machine position for chain lengths ");
  sayLengths();
  out_.line(FLASH(" . Please set the chains to a known length (Actions -> Set Chain Lengths)"));
  return false;
}

void Machine::restorePosition(const settings::Started& started) {
  using settings::Known;
  const settings::Position& kept = started.position;
  const bool is_kept = started.known != Known::kNothing;
  axes_.setCounts(is_kept ? kept.left : 0, is_kept ? kept.right : 0, is_kept ? kept.z : 0);
  keeper_.begin(started.known);
  switch (started.known) {
    case Known::kNothing:
      searchPlace();
      return sayUnset(started.source == settings::Source::kDefaults);
    case Known::kMoving:
      return losePosition(FLASH("Power was lost before the position was kept."));
    case Known::kDoubted:
      return losePosition(FLASH("The encoders' counts were wrong before power was lost."));
    case Known::kAtRest:
      break;
  }
  const bool is_found = findPlace();
  using settings::Agreement;
  const Agreement agreement = settings::compare(kept, memory_.scale(), place_.x, place_.y);
  if (agreement == Agreement::kScaleChanged)
    losePosition(
        FLASH("Encoders are scaled otherwise ($12, $13, $19, $20) than when it was kept."));
  else if (is_found && agreement == Agreement::kPlaceDiffers)
    losePosition(FLASH("The kept place is not where the chains put the sled."));
}

void Machine::sayUnset(bool has_defaults) {
  if (has_defaults) out_ << FLASH("Settings are the defaults. ");
  out_.line(
      FLASH("Chain lengths are not known yet: send your settings, then set the chains "
            "(Actions -> Set Chain Lengths, or B06 L R)."));
}

void Machine::losePosition(FlashText why) {
  keeper_.doubtChains();
  is_place_known_ = false;
  axes_.standStill();
  // Or the next move of z would set out from chains of no length.
  standHere();
  // WebControl looks for the first two words.
  out_ << FLASH("ALARM: Position Lost. ") << why << FLASH(" Last known chain lengths: ");
  sayLengths();
  out_.line(FLASH(" mm. Set them (B06 L R), or set the chains to their marks (B08)."));
}

void Machine::doubtCounts() {
  for (uint8_t i = 0; i < kAxisCount; ++i)
    if (axes_.isDisproved(Axis(i))) keeper_.doubt(Axis(i));
}

FlashText Machine::whatIsLost() const {
  return keeper_.trustsChains() ? FLASH("z is not known: set it first (G10 Z0 or G38.2)")
                                : FLASH("Position Lost: set the chain lengths first (B06 or B08)");
}

void Machine::keepWhenAtRest() {
  if (!keeper_.isDue(clock_.milliseconds())) return;
  // A motor that ran on, or a chain that was pulled: the next move begins where the sled is.
  for (uint8_t i = 0; i < kAxisCount; ++i)
    if (float(fabs(axes_.error(Axis(i)))) > kMovedByHand) searchPlace();
  settings::Position position;
  position.left = axes_.counts(kLeftAxis);
  position.right = axes_.counts(kRightAxis);
  position.z = axes_.counts(kZAxis);
  // The place is what the chains say, not what was asked for: that is what a start compares.
  const FoundPlace found =
      geometry_.forward(axes_.length(kLeftAxis), axes_.length(kRightAxis), {place_.x, place_.y});
  position.x = found.at.x;
  position.y = found.at.y;
  position.has_place = found.found;
  keeper_.keep(position);
}

bool Machine::awaitRecord() {
  const uint32_t start = clock_.milliseconds();
  while (!stopping_ && !keeper_.isSettled() && clock_.milliseconds() - start < kRecordMs)
    serveAndSleep();
  return !stopping_;
}

Place Machine::placeNow() {
  place_.z = axes_.length(kZAxis);
  if (!isMoving() || !is_place_known_) {
    place_.x = aim_.x;
    place_.y = aim_.y;
    return place_;
  }
  const SetPoint now = axes_.setPoint();
  const motion::Point<float> guess = {place_.x, place_.y};
  const FoundPlace found =
      geometry_.forward(motion::toMm<float>(now.left), motion::toMm<float>(now.right), guess);
  if (found.found) {
    place_.x = found.at.x;
    place_.y = found.at.y;
  }
  return place_;
}

}  // namespace machine
