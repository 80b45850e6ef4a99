// The value of every setting, in RAM: checked when set, read by row.
#pragma once

#include "table.h"

namespace settings {

/// Why a value is not taken.
enum class Refusal : uint8_t {
  kNone,        ///< it was taken
  kUnknown,     ///< no setting has that number
  kHidden,      ///< only the machine's own commands set it
  kNoNumber,    ///< NaN or infinite
  kOutOfRange,  ///< beyond the limits
  kBetween,     ///< not one of the steps
  kZero,        ///< the one value within the limits that makes no sense
};

/// Whether a row may hold the value.
Refusal judge(const Entry& entry, float value);

/// One float for each row of a table, in memory that the caller lends.
class Values {
 public:
  /// `room` has one float for each row; filled with the defaults.
  Values(const Table& table, float* room);

  const Table& table() const { return table_; }
  uint8_t count() const { return count_; }

  /// The value in a row; rows are named by the table's own enum.
  float at(uint8_t index) const { return value_[index]; }

  /// Where the rows from `index` on stand, one after the other.
  const float* from(uint8_t index) const { return value_ + index; }

  /// Sets a listed setting by its $-number, or says why not and changes nothing.
  Refusal set(uint8_t number, float value);

  /// Sets a row, hidden or not, for the machine's own commands and for loading.
  Refusal setRow(uint8_t index, float value);

  /// Every setting back to its default, those that are kept only on request.
  void reset(bool also_kept);

 private:
  const Table& table_;
  float* value_;
  uint8_t count_;
};

}  // namespace settings
