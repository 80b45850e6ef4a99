// The motors' power and the mark of motion.
#include "motor_power.h"

#include "settings_table.h"

namespace machine {
namespace {

const float kSlid = 0.4f;  // [mm] of an axis; SledPlace follows a sled that went farther

}  // namespace

bool MotorPower::wake() {
  rest_ = Rest::kUnwatched;
  if (!axes_.isPowered()) {
    keeper_.beginMoving();
    waiting_.waitWhile([&] { return !keeper_.mayMove(); });
  }
  const bool may = !waiting_.isStopping();
  if (may) axes_.follow();
  keeper_.endWait();
  if (may) last_busy_ms_ = waiting_.milliseconds();
  return may;
}

void MotorPower::restWhenIdle(bool is_busy) {
  const uint32_t now = waiting_.milliseconds();
  if (is_busy) last_busy_ms_ = now;
  if (rest_ == Rest::kLetGo && place_.farthestOff() > kSlid) return holdAgain();
  if (is_busy || !axes_.isPowered() || rest_ == Rest::kStayOn) return;
  if (now - last_busy_ms_ < uint32_t(values_.at(kIdleTime))) return;
  if (!doesFrictionHold()) return sayThatTheyStayOn();
  axes_.releaseAll();
  rest_ = Rest::kLetGo;
}

bool MotorPower::doesFrictionHold() const {
  // Nobody knows what hangs on chains that nobody has set.
  if (!place_.isKnown() || axes_.isSimulated()) return true;
  const Place at = place_.now(false);
  const float kPerMetre = 1000;  // [mm]
  return geometry_.torqueAt({at.x, at.y}) < values_.at(kHoldingTorque) * kPerMetre;
}

void MotorPower::sayThatTheyStayOn() {
  if (has_said_so_) return;
  has_said_so_ = true;
  out_.line(
      FLASH("The motors stay on: so high on the sheet the sled would slide ($77). Park it lower."));
}

void MotorPower::holdAgain() {
  if (!wake()) return;
  stayOn(true);
  out_.line(FLASH("The sled slid with its motors off: they hold it until after its next move."));
}

bool MotorPower::awaitRecord() {
  const uint32_t kRecordMs = 1000;  // writing a record takes 0.3 s
  const uint32_t start = waiting_.milliseconds();
  return waiting_.waitWhile(
      [&] { return !keeper_.isSettled() && waiting_.milliseconds() - start < kRecordMs; });
}

}  // namespace machine
