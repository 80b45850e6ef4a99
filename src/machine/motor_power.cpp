// The motors' power and the mark of motion.
#include "motor_power.h"

#include "settings_table.h"

namespace machine {
namespace {

const float kSlid = 0.4f;  // [mm] of an axis; SledPlace follows a sled that went farther

}  // namespace

bool MotorPower::wake() {
  rest_ = Rest::kUnwatched;
  if (!base_.axes.isPowered()) {
    base_.keeper.beginMoving();
    base_.waiting.waitWhile([&] { return !base_.keeper.mayMove(); });
  }
  const bool may = !base_.waiting.isStopping();
  if (may) base_.axes.follow();
  base_.keeper.endWait();
  if (may) last_busy_ms_ = base_.waiting.milliseconds();
  return may;
}

void MotorPower::restWhenIdle(bool is_busy) {
  const uint32_t now = base_.waiting.milliseconds();
  if (is_busy) last_busy_ms_ = now;
  if (rest_ == Rest::kLetGo && place_.farthestOff() > kSlid) return holdAgain();
  if (is_busy || !base_.axes.isPowered() || rest_ == Rest::kStayOn) return;
  if (now - last_busy_ms_ < uint32_t(base_.values.at(kIdleTime))) return;
  if (!doesFrictionHold()) return sayThatTheyStayOn();
  base_.axes.releaseAll();
  rest_ = Rest::kLetGo;
}

bool MotorPower::doesFrictionHold() const {
  // Nobody knows what hangs on chains that nobody has set.
  if (!place_.isKnown() || base_.axes.isSimulated()) return true;
  const Place at = place_.now(false);
  const float kPerMetre = 1000;  // [mm]
  return base_.geometry.torqueAt({at.x, at.y}) < base_.values.at(kHoldingTorque) * kPerMetre;
}

void MotorPower::sayThatTheyStayOn() {
  if (has_said_so_) return;
  has_said_so_ = true;
  base_.out.line(
      FLASH("The motors stay on: so high on the sheet the sled would slide ($77). Park it lower."));
}

void MotorPower::holdAgain() {
  if (!wake()) return;
  stayOn(true);
  base_.out.line(
      FLASH("The sled slid with its motors off: they hold it until after its next move."));
}

bool MotorPower::awaitRecord() {
  const uint32_t kRecordMs = 1000;  // writing a record takes 0.3 s
  const uint32_t start = base_.waiting.milliseconds();
  return base_.waiting.waitWhile([&] {
    return !base_.keeper.isSettled() && base_.waiting.milliseconds() - start < kRecordMs;
  });
}

}  // namespace machine
