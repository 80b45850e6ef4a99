// The motors' power and the mark of motion.
#include "parts.h"
#include "settings_table.h"

namespace machine {
namespace {

const float kSlid = 0.4f;  // [mm] of an axis; SledPlace follows a sled that went farther

}  // namespace

bool MotorPower::wake() {
  rest_ = Rest::kUnwatched;
  if (!parts_.axes.isPowered()) {
    parts_.keeper.beginMoving();
    parts_.waiting.waitWhile([&] { return !parts_.keeper.mayMove(); });
  }
  const bool may = !parts_.waiting.isStopping();
  if (may) parts_.axes.follow();
  parts_.keeper.endWait();
  if (may) last_busy_ms_ = parts_.waiting.milliseconds();
  return may;
}

void MotorPower::restWhenIdle(bool is_busy) {
  const uint32_t now = parts_.waiting.milliseconds();
  if (is_busy) last_busy_ms_ = now;
  if (rest_ == Rest::kLetGo && parts_.place.farthestOff() > kSlid) return holdAgain();
  if (is_busy || !parts_.axes.isPowered() || rest_ == Rest::kStayOn) return;
  if (now - last_busy_ms_ < uint32_t(parts_.values.at(kIdleTime))) return;
  if (!doesFrictionHold()) return sayThatTheyStayOn();
  parts_.axes.releaseAll();
  rest_ = Rest::kLetGo;
}

bool MotorPower::doesFrictionHold() const {
  // Until the chains are set, what hangs on them is unknown.
  if (!parts_.place.isKnown() || parts_.axes.isSimulated()) return true;
  const Place at = parts_.place.now(false);
  const float kPerMetre = 1000;  // [mm]
  return parts_.geometry.torqueAt({at.x, at.y}) < parts_.values.at(kHoldingTorque) * kPerMetre;
}

void MotorPower::sayThatTheyStayOn() {
  if (has_said_so_) return;
  has_said_so_ = true;
  parts_.out.line(
      FLASH("The motors stay on: so high on the sheet the sled would slide ($77). Park it lower."));
}

void MotorPower::holdAgain() {
  if (!wake()) return;
  stayOn(true);
  parts_.out.line(
      FLASH("The sled slid with its motors off: they hold it until after its next move."));
}

bool MotorPower::awaitRecord() {
  const uint32_t kRecordMs = 1000;  // writing a record takes 0.3 s
  const uint32_t start = parts_.waiting.milliseconds();
  return parts_.waiting.waitWhile([&] {
    return !parts_.keeper.isSettled() && parts_.waiting.milliseconds() - start < kRecordMs;
  });
}

bool MotorPower::goOnFromHere() {
  if (!(parts_.place.movedBy() > 0)) return true;
  return parts_.answers.refuseMotion(
      FLASH("the sled moved "), parts_.place.movedBy(),
      FLASH(" mm while its motors were off: bring it back, or begin again "
            "from where it is"));
}

bool MotorPower::doChainsFollow() {
  if (parts_.values.at(kMainPositionP) > 0 || parts_.axes.isSimulated()) return true;
  return parts_.answers.refuseMotion(
      FLASH("the chains do not follow while $21 is 0: connect your client, or send $21=1300"));
}

bool MotorPower::doesZFollow() {
  if (parts_.values.at(kZPositionP) > 0 || parts_.axes.isSimulated()) return true;
  return parts_.answers.refuseMotion(
      FLASH("z does not follow while $29 is 0: connect your client, or send $29=1300"));
}

}  // namespace machine
