// Where the sled is: found from the chains, kept over a power cut, said when it is not known.
#include "machine.h"

namespace machine {
namespace {

const float kSamePlace = 1;  // [mm] that settings changed since may move a kept place

}  // namespace

void Machine::sayPlace(float x, float y) {
  const float scale = modal.inInches() ? 1 / 25.4f : 1.0f;
  out.line(FLASH("position loaded at:"));
  out.fixed(x * scale, 2).end();
  out.fixed(y * scale, 2).end();
}

void Machine::sayLengths() {
  out.fixed(axes.length(kLeftAxis), 2) << FLASH(", ");
  out.fixed(axes.length(kRightAxis), 2);
}

bool Machine::searchPlace() {
  const motion::Point<float> guess = {place_.x, place_.y};
  const FoundPlace found =
      geometry.forward(axes.length(kLeftAxis), axes.length(kRightAxis), guess);
  axes.standStill();
  is_place_known_ = found.found && is_chains_known_;
  place_.x = found.found ? found.at.x : 0;
  place_.y = found.found ? found.at.y : 0;
  standHere();
  return found.found;
}

void Machine::standHere() {
  place_.z = axes.length(kZAxis);
  mover.standAt(place_, axes.setPoint());
  modal.moveTo({place_.x, place_.y, place_.z});
}

bool Machine::findPlace() {
  out.line(FLASH("[Forward Calculating Position]"));
  if (searchPlace()) {
    sayPlace(place_.x, place_.y);
    return true;
  }
  out << FLASH("Message: Unable to find valid machine position for chain lengths ");
  sayLengths();
  out.line(FLASH(" . Please set the chains to a known length (Actions -> Set Chain Lengths)"));
  return false;
}

void Machine::restorePosition(const settings::Started& started) {
  const settings::Position& kept = started.position;
  if (started.known == settings::Known::kNothing) {
    axes.setCounts(0, 0, 0);
    findPlace();
    return;
  }
  axes.setCounts(kept.left, kept.right, kept.z);
  if (started.known == settings::Known::kMoving) {
    losePosition(FLASH("Power was lost while the sled moved."));
    return;
  }
  if (!findPlace() || !kept.has_place) return;
  const bool same = float(fabs(place_.x - kept.x)) < kSamePlace &&
                    float(fabs(place_.y - kept.y)) < kSamePlace;
  if (!same) losePosition(FLASH("The kept place is not where the chains put the sled."));
}

void Machine::losePosition(FlashText why) {
  is_chains_known_ = is_place_known_ = false;
  axes.standStill();
  // WebControl looks for the first two words.
  out << FLASH("ALARM: Position Lost. ") << why << FLASH(" Last known chain lengths: ");
  sayLengths();
  out.line(FLASH(" mm. Set them (B06 L R), or set the chains to their marks (B08)."));
}

bool Machine::declareLengths(float left, float right) {
  axes.declare(kLeftAxis, left);
  axes.declare(kRightAxis, right);
  is_chains_known_ = true;
  const bool found = findPlace();
  keepPosition();
  return found;
}

void Machine::keepPosition() {
  // What is doubtful must not be found as certain after the next power cut.
  if (!is_chains_known_) return;
  settings::Position position;
  position.left = axes.counts(kLeftAxis);
  position.right = axes.counts(kRightAxis);
  position.z = axes.counts(kZAxis);
  position.x = place_.x;
  position.y = place_.y;
  position.has_place = is_place_known_;
  memory.keepPosition(position);
}

Place Machine::placeNow() {
  place_.z = axes.length(kZAxis);
  if (mover.isIdle() || !is_place_known_) return place_;
  const SetPoint now = axes.setPoint();
  const motion::Point<float> guess = {place_.x, place_.y};
  const FoundPlace found =
      geometry.forward(motion::toMm<float>(now.left), motion::toMm<float>(now.right), guess);
  if (found.found) {
    place_.x = found.at.x;
    place_.y = found.at.y;
  }
  return place_;
}

}  // namespace machine
