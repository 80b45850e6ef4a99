// Where the sled is: found from the chains, kept over a power cut, said when it is not known.
#include "machine.h"

namespace machine {
namespace {

const float kSamePlace = 1;  // [mm] that settings changed since may move a kept place

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
  is_place_known_ = found.found && is_chains_known_;
  place_.x = found.found ? found.at.x : 0;
  place_.y = found.found ? found.at.y : 0;
  standHere();
  return found.found;
}

void Machine::standHere() {
  place_.z = axes_.length(kZAxis);
  aim_ = place_;
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
  const settings::Position& kept = started.position;
  if (started.known == settings::Known::kNothing) {
    axes_.setCounts(0, 0, 0);
    findPlace();
    return;
  }
  axes_.setCounts(kept.left, kept.right, kept.z);
  if (started.known == settings::Known::kMoving) {
    losePosition(FLASH("Power was lost while the sled moved."));
    return;
  }
  if (!findPlace() || !kept.has_place) return;
  const bool same =
      float(fabs(place_.x - kept.x)) < kSamePlace && float(fabs(place_.y - kept.y)) < kSamePlace;
  if (!same) losePosition(FLASH("The kept place is not where the chains put the sled."));
}

void Machine::losePosition(FlashText why) {
  is_chains_known_ = is_place_known_ = false;
  axes_.standStill();
  // Or the next move of z would set out from chains of no length.
  standHere();
  // WebControl looks for the first two words.
  out_ << FLASH("ALARM: Position Lost. ") << why << FLASH(" Last known chain lengths: ");
  sayLengths();
  out_.line(FLASH(" mm. Set them (B06 L R), or set the chains to their marks (B08)."));
}

void Machine::keepPosition() {
  // What is doubtful must not be found as certain after the next power cut.
  if (!is_chains_known_) return;
  settings::Position position;
  position.left = axes_.counts(kLeftAxis);
  position.right = axes_.counts(kRightAxis);
  position.z = axes_.counts(kZAxis);
  position.x = aim_.x;
  position.y = aim_.y;
  position.has_place = is_place_known_;
  memory_.keepPosition(position);
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
