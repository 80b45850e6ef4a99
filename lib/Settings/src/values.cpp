// Checks values and stores them.
#include "values.h"

#include <math.h>

namespace settings {

Refusal judge(const Entry& entry, float value) {
  if (!isfinite(value)) return Refusal::kNoNumber;
  if (value < entry.low || value > entry.high) return Refusal::kOutOfRange;
  if (entry.step == kAnyValue) return Refusal::kNone;
  if (entry.step == kAnyButZero) return value == 0 ? Refusal::kZero : Refusal::kNone;
  // Whole numbers here are below 2^16, so the quotient of two of them is exact if it is whole.
  const float steps = (value - entry.low) / float(entry.step);
  return steps == floor(steps) ? Refusal::kNone : Refusal::kBetween;
}

Values::Values(const Table& table, float* room)
    : table_(table), value_(room), count_(table.count()) {
  reset(true);
}

Refusal Values::set(uint8_t number, float value) {
  const uint8_t index = indexOf(table_, number);
  if (index == kNoIndex) return Refusal::kUnknown;
  if (table_.at(index).access != Access::kListed) return Refusal::kHidden;
  return setRow(index, value);
}

Refusal Values::setRow(uint8_t index, float value) {
  if (index >= count_) return Refusal::kUnknown;
  const Refusal why = judge(table_.at(index), value);
  // Adding zero leaves no negative zero, which would be written as "-0".
  if (why == Refusal::kNone) value_[index] = value + 0.0f;
  return why;
}

void Values::reset(bool also_kept) {
  for (uint8_t i = 0; i < count_; ++i) {
    const Entry entry = table_.at(i);
    if (also_kept || entry.access != Access::kKept) value_[i] = entry.usual;
  }
}

}  // namespace settings
