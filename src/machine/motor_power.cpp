// The motors' power and the mark of motion.
#include "motor_power.h"

#include "settings_table.h"

namespace machine {

bool MotorPower::wake() {
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
  if (is_busy || !axes_.isPowered()) return;
  if (now - last_busy_ms_ >= uint32_t(values_.at(kIdleTime))) axes_.releaseAll();
}

bool MotorPower::awaitRecord() {
  const uint32_t kRecordMs = 1000;  // writing a record takes 0.3 s
  const uint32_t start = waiting_.milliseconds();
  return waiting_.waitWhile(
      [&] { return !keeper_.isSettled() && waiting_.milliseconds() - start < kRecordMs; });
}

}  // namespace machine
